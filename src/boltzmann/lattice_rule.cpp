#include "boltzmann/lattice_rule.hpp"

#include <bit>

#include "boltzmann/elementary.hpp"

namespace clca::boltzmann {
namespace {

constexpr int kWordBits = 64;

// The first components of exod2_base2_m20_CKN, see the header.
constexpr std::array<std::uint64_t, LatticeRule::kDimensions> kGenerator = {
    1,      182667, 469891, 498753, 110745, 446247, 250185, 118627, 245333, 283199,
    408519, 391023, 246327, 126539, 399185, 461527, 300343, 69681,  516695, 436179};

std::uint64_t reversed(std::uint64_t number, int bits) {
  std::uint64_t result = 0;
  for (int bit = 0; bit < bits; ++bit) {
    result |= (number >> static_cast<unsigned>(bit) & 1U) << static_cast<unsigned>(bits - 1 - bit);
  }
  return result;
}

}  // namespace

LatticeRule::LatticeRule(std::uint64_t points)
    : bits_(static_cast<int>(std::bit_width(points - 1))) {
  residues_.reserve(points);
  for (std::uint64_t residue = 0; residue >> static_cast<unsigned>(bits_) == 0; ++residue) {
    if (reversed(residue, bits_) < points) {
      residues_.push_back(static_cast<std::uint32_t>(residue));
    }
  }
}

void LatticeRule::shift(std::uint64_t seed, random::DrawCounter key) {
  for (std::uint64_t& component : shift_) {
    const random::Words words = random::drawn_words(seed, key, random::Purpose::lattice_shift);
    ++key.item;
    component = random::joined(words[0], words[1]);
  }
}

double LatticeRule::coordinate(std::uint64_t point, int dimension) const {
  const auto at = static_cast<std::size_t>(dimension);
  const std::uint64_t multiple = residues_[point] * kGenerator[at];
  // Fractions of 1 are in units of 2^-64. A shift by all 64 bits (one point) would be undefined.
  const std::uint64_t unshifted =
      bits_ == 0 ? 0 : multiple << static_cast<unsigned>(kWordBits - bits_);
  return open_uniform(unshifted + shift_[at]);
}

}  // namespace clca::boltzmann
