#pragma once
// A hash over all fields of a value, the same on every machine.

#include <bit>
#include <cstdint>

#include "clca/random/word_hash.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::reflection {

namespace detail {

template <Leaf T>
void hash(random::WordHash& words, const T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    words.add(std::bit_cast<std::uint64_t>(static_cast<double>(value)));
  } else {
    words.add(static_cast<std::uint64_t>(value));
  }
}

template <HasFields T>
void hash(random::WordHash& words, const T& value);

template <class T>
void hash(random::WordHash& words, const std::optional<T>& value) {
  words.add(value.has_value() ? 1 : 0);
  if (value) {
    hash(words, *value);
  }
}

template <Vector T>
void hash(random::WordHash& words, const T& values) {
  words.add(values.size());
  for (const auto& value : values) {
    hash(words, value);
  }
}

template <DynamicArray T>
void hash(random::WordHash& words, const T& values) {
  words.add(static_cast<std::uint64_t>(values.cols()));
  for (const auto value : values.reshaped()) {
    hash(words, value);
  }
}

template <HasFields T>
void hash(random::WordHash& words, const T& value) {
  std::apply([&](const auto&... field) { (hash(words, field), ...); }, value.fields());
}

}  // namespace detail

template <HasFields T>
std::uint64_t hash(const T& value) {
  random::WordHash words;
  detail::hash(words, value);
  return words.value();
}

}  // namespace clca::reflection
