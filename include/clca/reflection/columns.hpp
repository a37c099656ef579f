#pragma once
// Values as columns of numbers, one for each field however deep: what a file holds of them.
//
// The column of field `row` of the elements of vector `particles` is called `particles/row`. Beside
// the columns of a vector, string, optional or map stands `size` with the number of elements of
// each; elements that are plain numbers are called `values`, containers `each`.

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "clca/reflection/reflection.hpp"

namespace clca::reflection {

using Column =
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::uint32_t>,
                 std::vector<std::uint64_t>, std::vector<std::int32_t>, std::vector<double>,
                 std::vector<std::int64_t>>;
using Columns = std::map<std::string, Column>;  ///< by path

/// Columns that do not belong to the value: one is missing, too short, of other numbers.
class ColumnMismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

/// A number as a column holds it.
template <class T>
constexpr auto stored(T value) {
  if constexpr (std::is_enum_v<T>) {
    return stored(static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (std::same_as<T, bool> || std::same_as<T, char>) {
    return static_cast<std::uint8_t>(value);
  } else {
    return value;
  }
}
template <class T>
using Stored = decltype(stored(T()));

/// What is added to the path of a container for its elements.
template <class T>
constexpr const char* item_suffix() {
  if constexpr (Leaf<T>) {
    return "/values";
  } else {
    return Vector<T> || Optional<T> || Map<T> || DynamicArray<T> ? "/each" : "";
  }
}

/// Adds the addresses of the items of a container.
template <class T, class Item>
void add_items(T& container, std::vector<Item*>& items) {
  if constexpr (Optional<std::remove_const_t<T>>) {
    if (container) {
      items.push_back(&*container);
    }
  } else {
    for (auto& item : container) {
      items.push_back(&item);
    }
  }
}

/// Goes through many values of one type at once, given by their addresses, down to numbers and
/// containers, which `Self` handles in visit_contents().
template <class Self>
class Walk {
 public:
  template <class T>
  void walk(const std::string& path, const std::vector<T*>& values) {
    using Value = std::remove_const_t<T>;
    if constexpr (HasFields<Value>) {
      for_each_field<Value>([&](std::string_view name, auto part) {
        walk_parts(path + (path.empty() ? "" : "/") + std::string(name), values, part);
      });
    } else if constexpr (Pair<Value>) {
      walk_parts(path + "/first", values, [](T& value) { return &value.first; });
      walk_parts(path + "/second", values, [](T& value) { return &value.second; });
    } else if constexpr (Array<Value>) {
      for (std::size_t i = 0; i < std::tuple_size_v<Value>; ++i) {
        walk_parts(path + "/" + std::to_string(i), values, [i](T& value) { return &value[i]; });
      }
    } else if constexpr (std::same_as<Value, Eigen::Vector2d>) {
      walk_parts(path + "/x", values, [](T& value) { return value.data(); });
      walk_parts(path + "/y", values, [](T& value) { return value.data() + 1; });
    } else {
      static_cast<Self*>(this)->visit_contents(path, values);
    }
  }

 protected:
  template <class Item, class T>
  void walk_items(const std::string& path, const std::vector<T*>& containers) {
    std::vector<Item*> items;
    for (T* container : containers) {
      add_items(*container, items);
    }
    walk(path + item_suffix<std::remove_const_t<Item>>(), items);
  }

 private:
  template <class T, class Part>
  void walk_parts(const std::string& path, const std::vector<T*>& values, Part part) {
    std::vector<decltype(part(*values.front()))> parts(values.size());
    std::transform(values.begin(), values.end(), parts.begin(),
                   [&](T* value) { return part(*value); });
    walk(path, parts);
  }
};

class Encoder : public Walk<Encoder> {
 public:
  explicit Encoder(Columns& columns) : columns_(columns) {}

  template <Leaf T>
  void visit_contents(const std::string& path, const std::vector<const T*>& values) {
    std::vector<Stored<T>> column(values.size());
    std::transform(values.begin(), values.end(), column.begin(),
                   [](const T* value) { return stored(*value); });
    columns_[path] = std::move(column);
  }

  template <class T>
  void visit_contents(const std::string& path, const std::vector<const T*>& values) {
    std::vector<std::uint64_t> sizes;
    for (const T* value : values) {
      if constexpr (Optional<T>) {
        sizes.push_back(value->has_value() ? 1 : 0);
      } else {
        sizes.push_back(value->size());
      }
    }
    columns_[path + "/size"] = std::move(sizes);
    walk_items<const typename T::value_type>(path, values);
  }

  template <DynamicArray T>
  void visit_contents(const std::string& path, const std::vector<const T*>& values) {
    std::vector<std::uint64_t> sizes;
    std::vector<typename T::Scalar> numbers;
    for (const T* value : values) {
      sizes.push_back(static_cast<std::uint64_t>(value->cols()));
      numbers.insert(numbers.end(), value->data(), value->data() + value->size());
    }
    columns_[path + "/size"] = std::move(sizes);
    columns_[path + "/values"] = std::move(numbers);
  }

 private:
  Columns& columns_;
};

class Decoder : public Walk<Decoder> {
 public:
  Decoder(const Columns& columns, double max_bytes) : columns_(columns), bytes_left_(max_bytes) {}

  template <Leaf T>
  void visit_contents(const std::string& path, const std::vector<T*>& values) {
    const auto& column = find<Stored<T>>(path, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::same_as<T, bool>) {
        require(column[i] <= 1, path, "is neither yes nor no");
      }
      *values[i] = static_cast<T>(column[i]);
    }
  }

  template <Vector T>
  void visit_contents(const std::string& path, const std::vector<T*>& values) {
    const auto sizes = read_sizes(path, values.size(), sizeof(typename T::value_type));
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i]->resize(sizes[i]);
    }
    walk_items<typename T::value_type>(path, values);
  }

  template <Map T>
  void visit_contents(const std::string& path, const std::vector<T*>& values) {
    constexpr std::size_t kNodeBytes = 64;
    using Item = std::pair<typename T::key_type, typename T::mapped_type>;
    const auto sizes = read_sizes(path, values.size(), 2 * sizeof(Item) + kNodeBytes);
    std::vector<Item> all(sum(sizes));
    walk_items<Item>(path, std::vector{&all});
    auto next = all.begin();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto end = next + static_cast<std::ptrdiff_t>(sizes[i]);
      *values[i] = T(next, end);
      require(values[i]->size() == sizes[i], path, "has a key twice");
      next = end;
    }
  }

  template <Optional T>
  void visit_contents(const std::string& path, const std::vector<T*>& values) {
    const auto sizes = read_sizes(path, values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      require(sizes[i] <= 1, path, "is there more than once");
      if (sizes[i] == 0) {
        values[i]->reset();
      } else if constexpr (std::default_initializable<typename T::value_type>) {
        if (!values[i]->has_value()) {
          values[i]->emplace();
        }
      } else {
        require(values[i]->has_value(), path, "has no place here");
      }
    }
    walk_items<typename T::value_type>(path, values);
  }

  template <DynamicArray T>
  void visit_contents(const std::string& path, const std::vector<T*>& values) {
    using Number = typename T::Scalar;
    constexpr auto kRows = static_cast<std::size_t>(T::RowsAtCompileTime);
    const auto sizes = read_sizes(path, values.size(), kRows * sizeof(Number));
    const auto& numbers = find<Number>(path + "/values", kRows * sum(sizes));
    auto next = numbers.begin();
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i]->resize(T::RowsAtCompileTime, static_cast<Eigen::Index>(sizes[i]));
      const auto end = next + static_cast<std::ptrdiff_t>(kRows * sizes[i]);
      std::copy(next, end, values[i]->data());
      next = end;
    }
  }

 private:
  static void require(bool holds, const std::string& path, const char* reason) {
    if (!holds) {
      throw ColumnMismatch(path + " " + reason);
    }
  }
  static std::size_t sum(const std::vector<std::uint64_t>& sizes) {
    return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
  }

  template <class T>
  const std::vector<T>& find(const std::string& path, std::size_t size) const {
    const auto found = columns_.find(path);
    require(found != columns_.end(), path, "is missing");
    const auto* column = std::get_if<std::vector<T>>(&found->second);
    require(column != nullptr, path, "holds other numbers");
    require(column->size() == size, path, "is too long or too short");
    return *column;
  }

  /// Sizes of `count` containers; the memory that is left allows to allocate their items.
  std::vector<std::uint64_t> read_sizes(const std::string& path, std::size_t count,
                                        std::size_t item_bytes) {
    const auto& sizes = find<std::uint64_t>(path + "/size", count);
    for (const std::uint64_t size : sizes) {
      bytes_left_ -= static_cast<double>(size) * static_cast<double>(item_bytes + sizeof(void*));
      require(bytes_left_ >= 0, path, "needs more memory than the limit");
    }
    return sizes;
  }

  const Columns& columns_;
  double bytes_left_;
};

}  // namespace detail

/// Adds all fields of a value, whose paths begin with `path`.
template <class T>
void encode(const std::string& path, const T& value, Columns& columns) {
  detail::Encoder(columns).walk(path, std::vector<const T*>{&value});
}
template <HasFields T>
Columns encode(const T& value) {
  Columns columns;
  encode("", value, columns);
  return columns;
}

/// Sets all fields of a value from its columns. Vectors are resized; members that are no fields
/// keep their values, also in elements and in optionals that have a value. Allocates no more than
/// `max_bytes`. Throws ColumnMismatch; the value is then only partly set.
template <class T>
void decode(const std::string& path, const Columns& columns, double max_bytes, T& value) {
  detail::Decoder(columns, max_bytes).walk(path, std::vector<T*>{&value});
}
template <HasFields T>
void decode(const Columns& columns, double max_bytes, T& value) {
  decode("", columns, max_bytes, value);
}

}  // namespace clca::reflection
