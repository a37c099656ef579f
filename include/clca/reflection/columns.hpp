#pragma once
// Values as columns of numbers, one for each field however deep: what a file holds of them.
//
// The column of field `row` of the elements of vector `particles` is called `particles/row`. Beside
// the columns of a vector, string, optional or map stands `size` with the number of elements of
// each; elements that are plain numbers are called `values`, containers `each`.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
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
using Columns = std::map<std::string, Column>;

/// Columns that do not belong to the value: one is missing, too short, of other numbers.
class Mismatch : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The first column in which two sets differ; empty where none does.
std::string difference(const Columns& a, const Columns& b);

namespace detail {

template <class T>
struct StoredAs {
  using Type = T;
};
template <class T>
requires std::is_enum_v<T>
struct StoredAs<T> {
  using Type = typename StoredAs<std::underlying_type_t<T>>::Type;
};
template <>
struct StoredAs<bool> {
  using Type = std::uint8_t;
};
template <>
struct StoredAs<char> {
  using Type = std::uint8_t;
};
template <class T>
using Stored = typename StoredAs<T>::Type;

/// What the elements of a container add to its path.
template <class T>
constexpr const char* item_name() {
  if constexpr (Leaf<T>) {
    return "/values";
  } else {
    return Vector<T> || Optional<T> || Map<T> || DynamicArray<T> ? "/each" : "";
  }
}

template <class T>
std::vector<T*> addresses(std::vector<T>& values) {
  std::vector<T*> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [](T& value) { return &value; });
  return result;
}

/// Items of the containers as one list, with the size of each.
template <class Item, class Container>
std::vector<Item*> items_of(const std::vector<Container*>& containers) {
  std::vector<Item*> items;
  for (Container* container : containers) {
    for (auto& item : *container) {
      items.push_back(&item);
    }
  }
  return items;
}

class Encoder {
 public:
  explicit Encoder(Columns& columns) : columns_(columns) {}

  template <Leaf T>
  void add(const std::string& path, const std::vector<const T*>& values) {
    std::vector<Stored<T>> column(values.size());
    std::transform(values.begin(), values.end(), column.begin(),
                   [](const T* value) { return static_cast<Stored<T>>(*value); });
    columns_[path] = std::move(column);
  }

  template <Listed T>
  void add(const std::string& path, const std::vector<const T*>& values) {
    std::apply([&](const auto&... field) { (add_member(path, values, field), ...); }, T::fields());
  }

  template <class First, class Second>
  void add(const std::string& path, const std::vector<const std::pair<First, Second>*>& values) {
    using Pair = std::pair<First, Second>;
    add_member(path, values, field("first", &Pair::first));
    add_member(path, values, field("second", &Pair::second));
  }

  template <class T, std::size_t kSize>
  void add(const std::string& path, const std::vector<const std::array<T, kSize>*>& values) {
    for (std::size_t i = 0; i < kSize; ++i) {
      std::vector<const T*> parts;
      for (const auto* value : values) {
        parts.push_back(&(*value)[i]);
      }
      add(path + "/" + std::to_string(i), parts);
    }
  }

  void add(const std::string& path, const std::vector<const Eigen::Vector2d*>& values) {
    for (Eigen::Index i = 0; i < 2; ++i) {
      std::vector<const double*> parts;
      for (const Eigen::Vector2d* value : values) {
        parts.push_back(value->data() + i);
      }
      add(path + (i == 0 ? "/x" : "/y"), parts);
    }
  }

  template <Vector T>
  void add(const std::string& path, const std::vector<const T*>& values) {
    add_sizes(path, values);
    add_items(path, items_of<const typename T::value_type>(values));
  }

  template <class Key, class Value>
  void add(const std::string& path, const std::vector<const std::map<Key, Value>*>& values) {
    add_sizes(path, values);
    add_items(path, items_of<const std::pair<const Key, Value>>(values));
  }

  template <class T>
  void add(const std::string& path, const std::vector<const std::optional<T>*>& values) {
    std::vector<std::uint64_t> sizes;
    std::vector<const T*> items;
    for (const std::optional<T>* value : values) {
      sizes.push_back(value->has_value() ? 1 : 0);
      if (*value) {
        items.push_back(&**value);
      }
    }
    columns_[path + "/size"] = std::move(sizes);
    add_items(path, items);
  }

  template <DynamicArray T>
  void add(const std::string& path, const std::vector<const T*>& values) {
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
  template <class T, class Owner, class Member>
  void add_member(const std::string& path, const std::vector<const T*>& values,
                  const Field<Owner, Member>& field) {
    std::vector<const std::remove_const_t<Member>*> parts(values.size());
    std::transform(values.begin(), values.end(), parts.begin(),
                   [&](const T* value) { return &(value->*(field.member)); });
    add(path.empty() ? field.name : path + "/" + field.name, parts);
  }

  template <class T>
  void add_sizes(const std::string& path, const std::vector<const T*>& values) {
    std::vector<std::uint64_t> sizes;
    for (const T* value : values) {
      sizes.push_back(value->size());
    }
    columns_[path + "/size"] = std::move(sizes);
  }

  template <class T>
  void add_items(const std::string& path, const std::vector<const T*>& items) {
    add(path + item_name<T>(), items);
  }

  Columns& columns_;
};

class Decoder {
 public:
  Decoder(const Columns& columns, double max_bytes) : columns_(columns), bytes_left_(max_bytes) {}

  template <Leaf T>
  void read(const std::string& path, const std::vector<T*>& values) {
    const auto& column = find<Stored<T>>(path, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::same_as<T, bool>) {
        require(column[i] <= 1, path, "is neither yes nor no");
      }
      *values[i] = static_cast<T>(column[i]);
    }
  }

  template <Listed T>
  void read(const std::string& path, const std::vector<T*>& values) {
    std::apply([&](const auto&... field) { (read_member(path, values, field), ...); }, T::fields());
  }

  template <class First, class Second>
  void read(const std::string& path, const std::vector<std::pair<First, Second>*>& values) {
    using Pair = std::pair<First, Second>;
    read_member(path, values, field("first", &Pair::first));
    read_member(path, values, field("second", &Pair::second));
  }

  template <class T, std::size_t kSize>
  void read(const std::string& path, const std::vector<std::array<T, kSize>*>& values) {
    for (std::size_t i = 0; i < kSize; ++i) {
      std::vector<T*> parts;
      for (auto* value : values) {
        parts.push_back(&(*value)[i]);
      }
      read(path + "/" + std::to_string(i), parts);
    }
  }

  void read(const std::string& path, const std::vector<Eigen::Vector2d*>& values) {
    for (Eigen::Index i = 0; i < 2; ++i) {
      std::vector<double*> parts;
      for (Eigen::Vector2d* value : values) {
        parts.push_back(value->data() + i);
      }
      read(path + (i == 0 ? "/x" : "/y"), parts);
    }
  }

  template <Vector T>
  void read(const std::string& path, const std::vector<T*>& values) {
    const auto sizes = read_sizes(path, values.size(), sizeof(typename T::value_type));
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i]->resize(sizes[i]);
    }
    read_items(path, items_of<typename T::value_type>(values));
  }

  template <class Key, class Value>
  void read(const std::string& path, const std::vector<std::map<Key, Value>*>& values) {
    constexpr std::size_t kNodeBytes = 64;
    using Item = std::pair<Key, Value>;
    const auto sizes = read_sizes(path, values.size(), 2 * sizeof(Item) + kNodeBytes);
    std::vector<Item> all(sum(sizes));
    read_items(path, addresses(all));
    auto next = all.begin();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto end = next + static_cast<std::ptrdiff_t>(sizes[i]);
      *values[i] = std::map<Key, Value>(next, end);
      require(values[i]->size() == sizes[i], path, "has a key twice");
      next = end;
    }
  }

  template <class T>
  void read(const std::string& path, const std::vector<std::optional<T>*>& values) {
    const auto sizes = read_sizes(path, values.size(), 0);
    std::vector<T*> items;
    for (std::size_t i = 0; i < values.size(); ++i) {
      require(sizes[i] <= 1, path, "is there more than once");
      if (sizes[i] == 0) {
        values[i]->reset();
        continue;
      }
      if constexpr (std::default_initializable<T>) {
        items.push_back(*values[i] ? &**values[i] : &values[i]->emplace());
      } else {
        require(values[i]->has_value(), path, "has no place here");
        items.push_back(&**values[i]);
      }
    }
    read_items(path, items);
  }

  template <DynamicArray T>
  void read(const std::string& path, const std::vector<T*>& values) {
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
      throw Mismatch(path + " " + reason);
    }
  }
  static std::size_t sum(const std::vector<std::uint64_t>& sizes) {
    std::size_t total = 0;
    for (const std::uint64_t size : sizes) {
      total += size;
    }
    return total;
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

  /// Of `count` containers, whose items may be allocated afterwards: none is more than the memory
  /// that is left allows.
  std::vector<std::uint64_t> read_sizes(const std::string& path, std::size_t count,
                                        std::size_t item_bytes) {
    const auto& sizes = find<std::uint64_t>(path + "/size", count);
    for (const std::uint64_t size : sizes) {
      bytes_left_ -= static_cast<double>(size) * static_cast<double>(item_bytes + sizeof(void*));
      require(bytes_left_ >= 0, path, "needs more memory than the limit");
    }
    return sizes;
  }

  template <class T, class Owner, class Member>
  void read_member(const std::string& path, const std::vector<T*>& values,
                   const Field<Owner, Member>& field) {
    std::vector<Member*> parts(values.size());
    std::transform(values.begin(), values.end(), parts.begin(),
                   [&](T* value) { return &(value->*(field.member)); });
    read(path.empty() ? field.name : path + "/" + field.name, parts);
  }

  template <class T>
  void read_items(const std::string& path, const std::vector<T*>& items) {
    read(path + item_name<T>(), items);
  }

  const Columns& columns_;
  double bytes_left_;
};

}  // namespace detail

/// Adds all fields of a value, whose paths begin with `path`.
template <class T>
void encode(const std::string& path, const T& value, Columns& columns) {
  detail::Encoder(columns).add(path, std::vector<const T*>{&value});
}
template <Listed T>
Columns encode(const T& value) {
  Columns columns;
  encode("", value, columns);
  return columns;
}

/// Sets all fields of a value from its columns; vectors are resized, so that what else their
/// elements hold stays, and so it does in what is optional and there already. Allocates no more
/// than `max_bytes`. Throws Mismatch; the value is then only partly set.
template <class T>
void decode(const std::string& path, const Columns& columns, double max_bytes, T& value) {
  detail::Decoder(columns, max_bytes).read(path, std::vector<T*>{&value});
}
template <Listed T>
void decode(const Columns& columns, double max_bytes, T& value) {
  decode("", columns, max_bytes, value);
}

}  // namespace clca::reflection
