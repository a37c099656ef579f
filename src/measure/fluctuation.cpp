#include "clca/measure/fluctuation.hpp"

#include <algorithm>

namespace clca::measure {

namespace {

/// Displacements by the same lattice vector differ by rounding only, others by half a spacing or
/// more.
constexpr double kAtRest = 1e-9;  // square spacings

struct CellMotion {
  std::size_t particles = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();  // displacement
  double squares = 0;                              // sum of squared deviations from it

  bool is_sparse() const { return particles < Fluctuations::kMinParticles; }
  bool is_resting() const { return squares < kAtRest; }
  bool counts() const { return !is_sparse() && !is_resting(); }
  /// Squared deviation of one particle, corrected for the mean being that of its own cell.
  double energy(const Displacement& displacement) const {
    const auto count = static_cast<double>(particles);
    return (displacement.vector - mean).squaredNorm() * count / (count - 1);
  }
};

std::vector<CellMotion> cell_motions(const std::vector<Displacement>& displacements,
                                     const Grid& grid) {
  std::vector<CellMotion> cells(grid.size());
  for (const Displacement& displacement : displacements) {
    CellMotion& cell = cells[grid.index(displacement.from)];
    ++cell.particles;
    cell.mean += displacement.vector;
  }
  for (CellMotion& cell : cells) {
    cell.mean /= static_cast<double>(std::max<std::size_t>(cell.particles, 1));
  }
  for (const Displacement& displacement : displacements) {
    CellMotion& cell = cells[grid.index(displacement.from)];
    cell.squares += (displacement.vector - cell.mean).squaredNorm();
  }
  return cells;
}

/// Half the mean energy of the counted particles; 0 if there are none.
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

/// Bin of a particle by the energies of its own cell.
/// For n normal particles its share of the sum of squares is beta distributed with parameters 1 and
/// n - 2, so that P(larger) = (1 - share)^(n - 2).
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

void Fluctuations::add(const std::vector<Displacement>& displacements, const Grid& grid) {
  const std::vector<CellMotion> cells = cell_motions(displacements, grid);
  for (const CellMotion& cell : cells) {
    (cell.is_sparse() ? sparse_ : cell.is_resting() ? resting_ : samples_) += cell.particles;
  }
  const double scale = temperature(cells);
  for (const Displacement& displacement : displacements) {
    const CellMotion& cell = cells[grid.index(displacement.from)];
    if (cell.counts()) {
      const double energy = cell.energy(displacement);
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
