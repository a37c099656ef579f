#pragma once
// Quasi-random points: they fill the unit cube more evenly than independent ones.

#include <array>
#include <cstdint>
#include <vector>

#include "clca/random/words.hpp"

namespace clca::boltzmann {

/// A randomly shifted rank-1 lattice rule, generating vector of Cools, Kuo & Nuyens, SIAM J. Sci.
/// Comput. 28 (2006) 2162-2188: order-2 weights, 2^10 to 2^20 points.
/// Other numbers of points take the first points of the embedded sequence, in radical-inverse
/// order. Beyond 2^20 points only the parts of 2^20 are known to be good.
class LatticeRule {
 public:
  static constexpr int kDimensions = 20;

  /// At least one point, fewer than 2^32.
  explicit LatticeRule(std::uint64_t points);

  /// Shifts all points by a vector drawn with purpose lattice_shift; `key`: step and group.
  void shift(std::uint64_t seed, random::DrawCounter key);

  std::uint64_t point_count() const { return residues_.size(); }

  /// A number in (0, 1). Without a shift, the points ascend in dimension 0.
  double coordinate(std::uint64_t point, int dimension) const;

 private:
  int bits_ = 0;                         // the points are among those of a lattice of 2^bits_
  std::vector<std::uint32_t> residues_;  // by point: its multiple of the generator
  std::array<std::uint64_t, kDimensions> shift_{};  // in 2^-64
};

}  // namespace clca::boltzmann
