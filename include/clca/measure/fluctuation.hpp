#pragma once
// How the energies of fluctuating particles are distributed, as those of a gas would be: by
// chi-square.

#include <cstdint>
#include <vector>

#include "clca/boltzmann/distribution.hpp"
#include "clca/fields/fields.hpp"
#include "clca/measure/grid.hpp"
#include "clca/measure/snapshot.hpp"

namespace clca::measure {

/// Shares, by bins, of the energy X of the fluctuation of particles over many windows.
///
/// The velocity of a particle is its displacement over the window; its fluctuation u the velocity
/// less the mean over the n particles that began in its cell, each counting once; its energy
/// |u|^2 n/(n-1), as the mean was taken from these n. X is the energy in units of T, half the mean
/// energy: chi-square with 2 degrees of freedom where the components of u are normal. (The length
/// of a window drops out of X, which is why only displacements are added.)
class Fluctuations {
 public:
  static constexpr std::size_t kBins = 20;  ///< equally probable ones
  /// Particles of cells with fewer are sparse: left out, their mean saying too little.
  static constexpr std::size_t kFewest = 5;

  /// Adds a window.
  void add(const std::vector<Journey>& journeys, const Grid& grid);

  const boltzmann::Bins& bins() const { return bins_; }
  /// T is that of the whole window, as a homogeneous gas has one: over the particles that are
  /// neither sparse nor at rest. Zeros where there are no samples.
  std::vector<double> shares() const { return shares_of(counts_); }
  /// T is that of the cell: whether cells differ does not count, only how energy is shared inside
  /// each. X is transformed so that it is chi-square even for n normal particles.
  std::vector<double> local_shares() const { return shares_of(local_counts_); }

  /// Particles in the shares, summed over the windows.
  std::uint64_t samples() const { return samples_; }
  /// Share of all particles that were in a cell that was at rest or moved as one, and left out:
  /// there X is 0, or nothing at all if T is that of the cell.
  double resting_share() const { return of_all(resting_); }
  /// Share of all particles that were left out as sparse.
  double sparse_share() const { return of_all(sparse_); }

  bool has_all_bins() const { return counts_.size() == kBins && local_counts_.size() == kBins; }
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("counts", &Fluctuations::counts_),
                           field("local_counts", &Fluctuations::local_counts_),
                           field("samples", &Fluctuations::samples_),
                           field("resting", &Fluctuations::resting_),
                           field("sparse", &Fluctuations::sparse_));
  }

 private:
  std::vector<double> shares_of(const std::vector<std::uint64_t>& counts) const;
  double of_all(std::uint64_t particles) const;

  boltzmann::Bins bins_ = boltzmann::Bins::equiprobable(kBins, 2);
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kBins);
  std::vector<std::uint64_t> local_counts_ = std::vector<std::uint64_t>(kBins);
  std::uint64_t samples_ = 0;
  std::uint64_t resting_ = 0;
  std::uint64_t sparse_ = 0;
};

}  // namespace clca::measure
