#pragma once
// Values as lists of named fields: said once for each struct, and saving, loading, comparing and
// hashing follow from it.
//
// A struct that takes part has a member function
//
//   static constexpr auto fields() { return std::make_tuple(field("row", &Site::row), ...); }
//
// that lists what a run changes of it. Fields are numbers, enumerations, other such structs,
// strings, and std::vector, optional, array, pair and map of these, and Eigen's vectors and arrays.

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace clca::fields {

template <class Owner, class Member>
struct Field {
  const char* name;
  Member Owner::*member;
};

template <class Owner, class Member>
constexpr Field<Owner, Member> field(const char* name, Member Owner::*member) {
  return {name, member};
}

template <class T>
concept Leaf = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T>
concept Listed = requires {
  T::fields();
};

namespace detail {
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class Key, class Value>
inline constexpr bool is_map<std::map<Key, Value>> = true;
template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <>
inline constexpr bool is_vector<std::string> = true;
}  // namespace detail

template <class T>
concept Optional = detail::is_optional<T>;
template <class T>
concept Map = detail::is_map<T>;
/// std::vector or std::string.
template <class T>
concept Vector = detail::is_vector<T>;
/// Of numbers, with a size that is known only when it runs.
template <class T>
concept DynamicArray = requires {
  requires std::derived_from<T, Eigen::DenseBase<T>>;
  requires T::SizeAtCompileTime == Eigen::Dynamic;
};

}  // namespace clca::fields
