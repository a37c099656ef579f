#pragma once
// Values as lists of named fields: said once for each struct, and saving, loading and hashing
// follow from it.
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

namespace clca::reflection {

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
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsPair : std::false_type {};
template <class First, class Second>
struct IsPair<std::pair<First, Second>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t kSize>
struct IsArray<std::array<T, kSize>> : std::true_type {};
template <class T>
struct IsMap : std::false_type {};
template <class Key, class Value>
struct IsMap<std::map<Key, Value>> : std::true_type {};
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <>
struct IsVector<std::string> : std::true_type {};
}  // namespace detail

template <class T>
concept Optional = detail::IsOptional<T>::value;
template <class T>
concept Pair = detail::IsPair<T>::value;
template <class T>
concept Array = detail::IsArray<T>::value;
template <class T>
concept Map = detail::IsMap<T>::value;
/// std::vector or std::string.
template <class T>
concept Vector = detail::IsVector<T>::value;
/// Of numbers, with a size that is known only when it runs.
template <class T>
concept DynamicArray = requires {
  requires std::derived_from<T, Eigen::DenseBase<T>>;
  requires T::SizeAtCompileTime == Eigen::Dynamic;
};

/// Adds the fields of another value to those of one: numbers, or Eigen's vectors.
template <Listed T>
void add_fields(T& to, const T& other) {
  std::apply([&](const auto&... field) { ((to.*(field.member) += other.*(field.member)), ...); },
             T::fields());
}

}  // namespace clca::reflection
