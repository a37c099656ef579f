#include "clca/measure/fluctuation.hpp"

#include <algorithm>

namespace clca::measure {

namespace {

/// Journeys of equal lattice vectors differ by rounding only, all others by half a spacing or more.
constexpr double kAtRest = 1e-9;  // square spacings

struct CellMotion {
  std::size_t particles = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // displacement
  double squares = 0;                              // sum of squared deviations from it

  bool is_sparse() const { return particles < Fluctuations::kFewest; }
  bool is_resting() const { return squares < kAtRest; }
  bool counts() const { return !is_sparse() && !is_resting(); }
  /// Squared deviation of one of them, corrected for the mean being theirs.
  double energy(const Journey& journey) const {
    const auto count = static_cast<double>(particles);
    return (journey.displacement - mean).squaredNorm() * count / (count - 1);
  }
};

std::vector<CellMotion> cell_motions(const std::vector<Journey>& journeys, const Grid& grid) {
  std::vector<CellMotion> cells(grid.size());
  for (const Journey& journey : journeys) {
    CellMotion& cell = cells[grid.index(journey.from)];
    ++cell.particles;
    cell.mean += journey.displacement;
  }
  for (CellMotion& cell : cells) {
    cell.mean /= static_cast<double>(std::max<std::size_t>(cell.particles, 1));
  }
  for (const Journey& journey : journeys) {
    CellMotion& cell = cells[grid.index(journey.from)];
    cell.squares += (journey.displacement - cell.mean).squaredNorm();
  }
  return cells;
}

/// Half the mean energy of the particles that count; 0 where none does.
double temperature(const std::vector<CellMotion>& cells) {
  double energies = 0;
  double particles = 0;
  for (const CellMotion& cell : cells) {
    if (cell.counts()) {
      const auto count = static_cast<double>(cell.particles);
      energies += cell.squares * count / (count - 1);
      particles += count;
    }
  }
  return particles > 0 ? energies / particles / 2 : 0;
}

/// Bin of a particle by the energies of its own cell. Its energy over the sum of squares is, for n
/// normal particles, a part with 2 degrees of freedom of a whole with 2 (n - 1): beta distributed
/// with parameters 1 and n - 2, so that a share (1 - part)^(n - 2) lies beyond it.
std::size_t local_bin(const CellMotion& cell, double energy) {
  const double rest = std::max(0.0, 1 - energy / cell.squares);
  double beyond = 1;  // by multiplication: the last bit of pow is not the same everywhere
  for (std::size_t i = 2; i < cell.particles; ++i) {
    beyond *= rest;
  }
  const auto bin = static_cast<std::size_t>((1 - beyond) * Fluctuations::kBins);
  return std::min(bin, Fluctuations::kBins - 1);
}

}  // namespace

void Fluctuations::add(const std::vector<Journey>& journeys, const Grid& grid) {
  const std::vector<CellMotion> cells = cell_motions(journeys, grid);
  for (const CellMotion& cell : cells) {
    (cell.is_sparse() ? sparse_ : cell.is_resting() ? resting_ : samples_) += cell.particles;
  }
  const double scale = temperature(cells);
  for (const Journey& journey : journeys) {
    const CellMotion& cell = cells[grid.index(journey.from)];
    if (cell.counts()) {
      const double energy = cell.energy(journey);
      ++counts_[bins_.find(energy / scale)];
      ++local_counts_[local_bin(cell, energy)];
    }
  }
}

std::vector<double> Fluctuations::shares_of(const std::vector<std::uint64_t>& counts) const {
  std::vector<double> shares(counts.size(), 0.0);
  for (std::size_t bin = 0; bin < counts.size() && samples_ > 0; ++bin) {
    shares[bin] = static_cast<double>(counts[bin]) / static_cast<double>(samples_);
  }
  return shares;
}

double Fluctuations::of_all(std::uint64_t particles) const {
  const auto all = static_cast<double>(samples_ + resting_ + sparse_);
  return all > 0 ? static_cast<double>(particles) / all : 0;
}

}  // namespace clca::measure
