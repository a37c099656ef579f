#pragma once
// All 128 bits of one Philox4x32-10 call, for code that needs many draws at once.

#include <Random123/philox.h>

#include <array>
#include <cstdint>

#include "clca/random/draw.hpp"

namespace clca::random {

using Words = std::array<std::uint32_t, 4>;

/// The counter of a draw without its purpose, which defines the meaning of group and item.
struct DrawCounter {
  std::uint32_t step = 0;
  std::uint32_t group = 0;
  std::uint32_t item = 0;
};

/// A pure function of its arguments: key = seed, counter = the rest.
inline Words drawn_words(std::uint64_t seed, const DrawCounter& counter, Purpose purpose) {
  constexpr unsigned kWordBits = 32;
  const r123::Philox4x32::ctr_type input = {
      {counter.step, counter.group, counter.item, static_cast<std::uint32_t>(purpose)}};
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> kWordBits)}};
  const auto output = r123::Philox4x32{}(input, key);
  return {output[0], output[1], output[2], output[3]};
}

/// Two of the words as 64 bits.
inline std::uint64_t joined(std::uint32_t low, std::uint32_t high) {
  return (static_cast<std::uint64_t>(high) << 32U) | low;
}

}  // namespace clca::random
