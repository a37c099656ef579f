#pragma once
// Distribution of the fluctuation energies of particles, to compare with chi-square as in a gas.

#include <cstdint>
#include <vector>

#include "clca/measure/grid.hpp"
#include "clca/measure/snapshot.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/statistics/distribution.hpp"

namespace clca::measure {

/// Histogram of the fluctuation energy X of particles over many windows.
/// The velocity of a particle is its displacement in the window; its fluctuation u is the
/// difference from the mean over the n particles that started in its cell; its energy is |u|^2
/// n/(n-1), as the mean came from these n.
/// X is this energy divided by T, half the mean energy: chi-square with 2 degrees of freedom if u
/// is normal. The window length cancels, so displacements suffice.
class Fluctuations {
 public:
  static constexpr std::size_t kBins = 20;  ///< equally probable ones
  /// Cells with fewer particles are ignored ("sparse"): their mean is too uncertain.
  static constexpr std::size_t kMinParticles = 5;

  /// Adds a window.
  void add(const std::vector<Displacement>& displacements, const Grid& grid);

  const statistics::Bins& bins() const { return bins_; }
  /// With T of the whole window, as in a homogeneous gas: over particles that are neither sparse
  /// nor at rest. Zeros without samples.
  std::vector<double> shares() const { return shares_of(counts_); }
  /// With T of each cell, so that only differences inside a cell count. X is transformed to be
  /// chi-square even for small n.
  std::vector<double> local_shares() const { return shares_of(local_counts_); }

  /// Particles counted, summed over the windows.
  std::uint64_t samples() const { return samples_; }
  /// Share of all particles left out because their cell was at rest or moved rigidly: X would be 0
  /// or, with T of the cell, undefined.
  double resting_share() const { return of_all(resting_); }
  /// Share of all particles that were left out as sparse.
  double sparse_share() const { return of_all(sparse_); }

  bool has_all_bins() const { return counts_.size() == kBins && local_counts_.size() == kBins; }
  CLCA_FIELDS(counts_, local_counts_, samples_, resting_, sparse_);

 private:
  std::vector<double> shares_of(const std::vector<std::uint64_t>& counts) const;
  double of_all(std::uint64_t particles) const;

  statistics::Bins bins_ = statistics::Bins::equiprobable(kBins, 2);
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kBins);
  std::vector<std::uint64_t> local_counts_ = std::vector<std::uint64_t>(kBins);
  std::uint64_t samples_ = 0;
  std::uint64_t resting_ = 0;
  std::uint64_t sparse_ = 0;
};

}  // namespace clca::measure
