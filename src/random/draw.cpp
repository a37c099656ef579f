#include "clca/random/draw.hpp"

#include <stdexcept>

#include "clca/random/words.hpp"

namespace clca::random {

namespace {
__extension__ using Uint128 = unsigned __int128;
}  // namespace

std::uint64_t draw(std::uint64_t seed, std::uint64_t step, std::uint32_t item, Purpose purpose) {
  constexpr unsigned kWordBits = 32;
  const DrawCounter counter = {.step = static_cast<std::uint32_t>(step),
                               .group = static_cast<std::uint32_t>(step >> kWordBits),
                               .item = item};
  const Words drawn = drawn_words(seed, counter, purpose);
  return joined(drawn[0], drawn[1]);
}

std::uint64_t uniform_below(std::uint64_t bits, std::uint64_t count) {
  return static_cast<std::uint64_t>((static_cast<Uint128>(bits) * count) >> 64U);
}

Probability::Probability(double value) {
  if (!(value >= 0.0 && value <= 1.0)) {
    throw std::invalid_argument("a probability lies in [0, 1]");
  }
  threshold_ = static_cast<std::uint64_t>(value * 0x1p63);  // exact: a power of two
}

}  // namespace clca::random
