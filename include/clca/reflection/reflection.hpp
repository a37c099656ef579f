#pragma once
// Values as lists of named fields: said once for each struct, and saving, loading and hashing
// follow from it.
//
// A struct that takes part has a line
//
//   CLCA_FIELDS(column, row);
//
// that lists what a run changes of it. Fields are numbers, enumerations, other such structs,
// strings, and std::vector, optional, array, pair and map of these, and Eigen's vectors and arrays.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

/// Declares fields: the names of members, and references to them in a value.
#define CLCA_FIELDS(...)          \
  auto fields() {                 \
    return std::tie(__VA_ARGS__); \
  }                               \
  auto fields() const {           \
    return std::tie(__VA_ARGS__); \
  }                               \
  static constexpr std::string_view kFieldNames = #__VA_ARGS__

namespace clca::reflection {

/// What fills one column: a number, a truth value, an enumeration.
template <class T>
concept Leaf = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// A struct with CLCA_FIELDS.
template <class T>
concept HasFields = requires {
  T::kFieldNames;
};

/// Calls `visit(name, part)` for each field: its name, without the underscore at the end of a
/// private one, and a function that gives its address in a value.
template <HasFields T, class Visit>
void for_each_field(const Visit& visit) {
  std::string_view names = T::kFieldNames;
  const auto next_name = [&names] {
    const std::string_view name = names.substr(0, names.find(','));
    names.remove_prefix(std::min(names.size(), name.size() + 2));
    return name.substr(0, name.size() - (name.ends_with('_') ? 1 : 0));
  };
  using Fields = decltype(std::declval<T&>().fields());
  [&]<std::size_t... kField>(std::index_sequence<kField...>) {
    (visit(next_name(), [](auto& value) { return &std::get<kField>(value.fields()); }), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<Fields>>());
}

namespace detail {
/// Whether T is an instance of the template `Of`.
template <class T, template <class...> class Of>
inline constexpr bool kIsInstance = false;
template <class... Parts, template <class...> class Of>
inline constexpr bool kIsInstance<Of<Parts...>, Of> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t kSize>
inline constexpr bool kIsArray<std::array<T, kSize>> = true;
}  // namespace detail

template <class T>
concept Optional = detail::kIsInstance<T, std::optional>;
template <class T>
concept Pair = detail::kIsInstance<T, std::pair>;
template <class T>
concept Array = detail::kIsArray<T>;
template <class T>
concept Map = detail::kIsInstance<T, std::map>;
/// std::vector or std::string.
template <class T>
concept Vector = detail::kIsInstance<T, std::vector> || std::same_as<T, std::string>;
/// An Eigen array or vector of numbers whose size is known only at run time.
template <class T>
concept DynamicArray = requires {
  requires std::derived_from<T, Eigen::DenseBase<T>>;
  requires T::SizeAtCompileTime == Eigen::Dynamic;
};

/// Adds the fields of another value to those of one: numbers, or Eigen's vectors.
template <HasFields T>
void add_fields(T& to, const T& other) {
  for_each_field<T>([&](std::string_view, auto part) { *part(to) += *part(other); });
}

}  // namespace clca::reflection
