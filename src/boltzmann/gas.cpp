#include "clca/boltzmann/gas.hpp"

#include <bit>

#include "clca/random/draw.hpp"
#include "random/word_hash.hpp"

namespace clca::boltzmann {

std::uint64_t hash(const Gas& gas) {
  random::WordHash words;
  words.add(std::bit_cast<std::uint64_t>(gas.time));
  words.add(gas.step);
  words.add(gas.participations);
  words.add(std::bit_cast<std::uint64_t>(gas.thermal_speed));
  words.add(static_cast<std::uint64_t>(gas.particles()));
  for (const double value : gas.motions.reshaped()) {
    words.add(std::bit_cast<std::uint64_t>(value));
  }
  return words.value();
}

std::uint64_t member_seed(std::uint64_t seed, std::uint64_t member) {
  return member == 0 ? seed : random::draw(seed, member, 0, random::Purpose::member);
}

}  // namespace clca::boltzmann
