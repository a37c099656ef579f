#include "clca/boltzmann/gas.hpp"

#include "clca/random/draw.hpp"
#include "clca/reflection/hash.hpp"

namespace clca::boltzmann {

std::uint64_t hash(const Gas& gas) {
  return reflection::hash(gas);
}

std::uint64_t member_seed(std::uint64_t seed, std::uint64_t member) {
  return member == 0 ? seed : random::draw(seed, member, 0, random::Purpose::member);
}

}  // namespace clca::boltzmann
