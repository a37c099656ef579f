#pragma once
// Coarse-grained fields on the cells of a grid, and in rectangles of the box (probes): packing,
// velocity and its fluctuations; the distribution of the fluctuations; stress.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/region.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/measure/grid.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/statistics/sample.hpp"

namespace clca::measure {

/// Means over the particles that start in a region, weighted by their sites.
struct RegionMotion {
  double particles = 0;  ///< at least one; half of each on an edge between two regions
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double fluctuation = 0;  ///< 1/2 <|v - <v>|^2>, the granular temperature
};

/// Means over the particles that started the window in the cell.
struct FieldCell : RegionMotion {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< lattice spacings
  double packing_fraction = 0;                       ///< share of its sites taken by particles now
};

/// Memory of so many cells, with that for measuring them and their fluctuations.
inline double field_bytes(double cells) {
  return cells * (sizeof(FieldCell) + 2 * sizeof(RegionMotion) + 2 * sizeof(double));
}

/// Fields of the window of steps from `begin` to now, in the cells of a Grid of side `cell`
/// (lattice spacings): velocity is displacement per step. Particles that entered or left during the
/// window count for the packing only. In a window of zero steps all velocities are 0.
std::vector<FieldCell> field_cells(const Snapshot& begin, const grains::State& now, double cell);

/// Mean fluctuation over cells, weighted by their particles; 0 if there are none.
double mean_fluctuation(const std::vector<FieldCell>& cells);

/// For each region, the share of its sites without walls that particles cover; 0 if there are none.
std::vector<double> filled_shares(const grains::State& state,
                                  std::span<const lattice::Rectangle> regions);

/// Motion from displacements in `steps` steps; none if no particle starts in the region.
std::optional<RegionMotion> region_motion(const lattice::Rectangle& region,
                                          const std::vector<Displacement>& displacements,
                                          double steps);

/// Sites of the particles whose centre of mass has passed the horizontal middle line of the region
/// downwards, less those that have passed it upwards, on straight paths (Snapshot::displacement).
double sites_moved_down(const Snapshot& before, const grains::State& now,
                        const lattice::Rectangle& region);

/// Histogram of the fluctuation energy X of particles over many windows.
/// The velocity of a particle is its displacement in the window; its fluctuation u is the
/// difference from the mean over the n particles that started in its cell; its energy is |u|^2
/// n/(n-1), as the mean came from these n.
/// X is this energy divided by T, half the mean energy: chi-square with 2 degrees of freedom if u
/// is normal. The window length cancels, so displacements suffice.
class FluctuationHistogram {
 public:
  static constexpr std::size_t kBinCount = 20;  ///< equally probable ones
  /// Cells with fewer particles are ignored ("sparse"): their mean is too uncertain.
  static constexpr std::size_t kMinParticles = 5;

  /// Adds a window.
  void add(const std::vector<Displacement>& displacements, const Grid& grid);

  const statistics::Bins& bins() const { return bins_; }
  /// Shares of the bins, with T of the whole window, as in a homogeneous gas: over particles that
  /// are neither sparse nor at rest. Zeros without samples.
  std::vector<double> bin_shares() const { return shares_of(counts_); }
  /// The same with T of each cell; X is transformed to be chi-square even for small n.
  std::vector<double> local_bin_shares() const { return shares_of(local_counts_); }

  /// Particles counted, summed over the windows.
  std::uint64_t sample_count() const { return samples_; }
  /// Share of all particles left out because their cell was at rest or moved rigidly (T = 0).
  double resting_share() const { return share_of_all(resting_); }
  /// Share of all particles that were left out as sparse.
  double sparse_share() const { return share_of_all(sparse_); }

  bool has_all_bins() const {
    return counts_.size() == kBinCount && local_counts_.size() == kBinCount;
  }
  CLCA_FIELDS(counts_, local_counts_, samples_, resting_, sparse_);

 private:
  std::vector<double> shares_of(const std::vector<std::uint64_t>& counts) const;
  double share_of_all(std::uint64_t particles) const;

  statistics::Bins bins_ = statistics::Bins::equiprobable(kBinCount, 2);
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kBinCount);
  std::vector<std::uint64_t> local_counts_ = std::vector<std::uint64_t>(kBinCount);
  std::uint64_t samples_ = 0;
  std::uint64_t resting_ = 0;
  std::uint64_t sparse_ = 0;
};

/// Stress in weights of a grain of mean mass per lattice spacing; compression is positive.
struct StressCell {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< lattice spacings
  double xx = 0;
  double xy = 0;  ///< of the symmetric part
  double yy = 0;

  double pressure() const { return (xx + yy) / 2; }
};

/// Contact stress 1/A sum(force x branch vector) on a Grid of side `cell` (lattice spacings).
/// Each cell takes the part of a branch inside it (Irving & Kirkwood 1950), so that yy averaged
/// over a row of cells is the weight carried there. The branch of a wall contact is extended
/// through the wall, against the normal, to its far side. The kinetic part is left out.
std::vector<StressCell> stress_field(const grains::State& state,
                                     std::span<const contact::Force> forces, double cell);

}  // namespace clca::measure
