#include "clca/random/draw.hpp"

#include <Random123/philox.h>

#include <stdexcept>

namespace clca::random {

namespace {
constexpr unsigned kWordBits = 32;
__extension__ using Uint128 = unsigned __int128;

std::uint32_t low_word(std::uint64_t value) {
  return static_cast<std::uint32_t>(value);
}
std::uint32_t high_word(std::uint64_t value) {
  return static_cast<std::uint32_t>(value >> kWordBits);
}
}  // namespace

std::uint64_t draw(std::uint64_t seed, std::uint64_t step, std::uint32_t item, Purpose purpose) {
  const r123::Philox4x32::ctr_type counter = {
      {low_word(step), high_word(step), item, static_cast<std::uint32_t>(purpose)}};
  const r123::Philox4x32::key_type key = {{low_word(seed), high_word(seed)}};
  const auto words = r123::Philox4x32{}(counter, key);
  return (static_cast<std::uint64_t>(words[1]) << kWordBits) | words[0];
}

std::uint64_t below(std::uint64_t bits, std::uint64_t count) {
  return static_cast<std::uint64_t>((static_cast<Uint128>(bits) * count) >> 64U);
}

Probability::Probability(double value) {
  if (!(value >= 0.0 && value <= 1.0)) {
    throw std::invalid_argument("a probability lies in [0, 1]");
  }
  threshold_ = static_cast<std::uint64_t>(value * 0x1p63);  // exact: a power of two
}

}  // namespace clca::random
