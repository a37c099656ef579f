#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <random>

#include "clca/measure/field_grid.hpp"

namespace clca::measure::fluctuation_test {
namespace {

using Displacements = std::vector<Eigen::Vector2d>;

/// A grid of cells in a row.
Grid row_of_cells(int cells) {
  return {lattice::Lattice(cells * 12, 10, false), 12 * lattice::kColumnPitch};
}

/// Particles that begin in one cell of a row.
void add_cell(std::vector<Displacement>& particles, const Grid& grid, std::size_t cell,
              const Displacements& displacements) {
  for (const Eigen::Vector2d& displacement : displacements) {
    particles.push_back({.from = grid.cell_centre(cell), .vector = displacement, .sites = 1});
  }
}

double distance(const std::vector<double>& shares) {
  const std::vector<double> reference(shares.size(), 1.0 / static_cast<double>(shares.size()));
  return statistics::hellinger_distance(shares, reference);
}

/// Normal displacements about a drift of the cell, the standard deviations going from 1 to
/// `hottest` along the cells and the numbers of particles from 5 to 40.
FluctuationHistogram normal_windows(int windows, double hottest) {
  constexpr std::array<std::size_t, 4> kCounts = {5, 8, 15, 40};
  const Grid grid = row_of_cells(20);
  FluctuationHistogram result;
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  for (int window = 0; window < windows; ++window) {
    std::vector<Displacement> particles;
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const double share = static_cast<double>(cell) / static_cast<double>(grid.size() - 1);
      const double deviation = 1 + (hottest - 1) * share;
      Displacements displacements(kCounts[cell % kCounts.size()]);
      for (Eigen::Vector2d& displacement : displacements) {
        displacement = {100 * share + deviation * normal(engine), deviation * normal(engine)};
      }
      add_cell(particles, grid, cell, displacements);
    }
    result.add(particles, grid);
  }
  return result;
}

TEST(Fluctuations, OfNormalDisplacementsAreChiSquareUpToTheNoiseFloor) {
  const FluctuationHistogram fluctuations = normal_windows(200, 1);
  ASSERT_EQ(fluctuations.sample_count(), 200U * 5 * (5 + 8 + 15 + 40));
  // The distance of equals is the floor times chi-square with about 18 degrees over 18: three times
  // the floor has odds of 1e-5.
  const double floor = statistics::expected_hellinger_distance(FluctuationHistogram::kBinCount,
                                                               fluctuations.sample_count());
  EXPECT_LT(distance(fluctuations.bin_shares()), 3 * floor);
  EXPECT_LT(distance(fluctuations.local_bin_shares()), 3 * floor);
}

TEST(Fluctuations, CellsOfUnequalHeatAreSeenOnlyOnTheScaleOfTheWindow) {
  const FluctuationHistogram fluctuations = normal_windows(200, 3);
  const double floor = statistics::expected_hellinger_distance(FluctuationHistogram::kBinCount,
                                                               fluctuations.sample_count());
  EXPECT_GT(distance(fluctuations.bin_shares()), 100 * floor);
  EXPECT_LT(distance(fluctuations.local_bin_shares()), 3 * floor);
}

// By hand. A cell of 5: energies 5/4, 5/4, 5/4, 5/4, 0. A cell of 9: eight times 9/8, and 0. Half
// the mean of the 14 energies is 1/2, and so X = 2.5, 2.25 and 0, at the quantiles 1 - exp(-X/2) =
// 0.713, 0.675 and 0. Without n/(n-1) it would be 7/3 in both cells.
TEST(Fluctuations, AreCorrectedForTheMeanTakenFromFewParticles) {
  const Grid grid = row_of_cells(2);
  std::vector<Displacement> particles;
  add_cell(particles, grid, 0, {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {0, 0}});
  add_cell(particles, grid, 1,
           {{1, 0}, {-1, 0}, {1, 0}, {-1, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {0, 0}});
  FluctuationHistogram fluctuations;
  fluctuations.add(particles, grid);
  EXPECT_EQ(fluctuations.sample_count(), 14U);
  const std::vector<double> shares = fluctuations.bin_shares();
  EXPECT_DOUBLE_EQ(shares[0], 2.0 / 14);
  EXPECT_DOUBLE_EQ(shares[13], 8.0 / 14);
  EXPECT_DOUBLE_EQ(shares[14], 4.0 / 14);
  // By cell: parts 5/16 and 9/64 of the sums, quantiles 1 - (11/16)^3 = 0.675, 1 - (55/64)^7 =
  // 0.654.
  const std::vector<double> local = fluctuations.local_bin_shares();
  EXPECT_DOUBLE_EQ(local[0], 2.0 / 14);
  EXPECT_DOUBLE_EQ(local[13], 12.0 / 14);
}

TEST(Fluctuations, LeaveOutCellsThatRestOrMoveAsOneOrHoldTooFewAndSaySo) {
  const Grid grid = row_of_cells(4);
  std::vector<Displacement> particles;
  add_cell(particles, grid, 0, Displacements(8, Eigen::Vector2d(0, 0)));
  add_cell(particles, grid, 1, Displacements(12, Eigen::Vector2d(0.1, 0.7)));
  add_cell(particles, grid, 2, {{1, 0}, {-1, 0}, {0, 1}, {0, -1}});
  add_cell(particles, grid, 3, {{3, 0}, {1, 0}, {2, 1}, {2, -1}, {2, 2}, {2, -2}});
  FluctuationHistogram fluctuations;
  fluctuations.add(particles, grid);
  EXPECT_EQ(fluctuations.sample_count(), 6U);
  EXPECT_DOUBLE_EQ(fluctuations.resting_share(), 20.0 / 30);
  EXPECT_DOUBLE_EQ(fluctuations.sparse_share(), 4.0 / 30);
  const std::vector<double> shares = fluctuations.bin_shares();
  EXPECT_DOUBLE_EQ(std::accumulate(shares.begin(), shares.end(), 0.0), 1);
}

TEST(Fluctuations, HaveNoSamplesWhereAllRestOrNobodyIsThere) {
  const Grid grid = row_of_cells(1);
  FluctuationHistogram fluctuations;
  fluctuations.add({}, grid);
  EXPECT_EQ(fluctuations.resting_share(), 0);
  std::vector<Displacement> particles;
  add_cell(particles, grid, 0, Displacements(9, Eigen::Vector2d(0, 0)));
  fluctuations.add(particles, grid);
  EXPECT_EQ(fluctuations.sample_count(), 0U);
  EXPECT_EQ(fluctuations.resting_share(), 1);
  EXPECT_EQ(fluctuations.bin_shares(), std::vector<double>(FluctuationHistogram::kBinCount, 0.0));
  EXPECT_EQ(fluctuations.local_bin_shares(),
            std::vector<double>(FluctuationHistogram::kBinCount, 0.0));
}

TEST(Fluctuations, OneThatMovesAmongRestingOnesIsAsFarOutAsCanBe) {
  const Grid grid = row_of_cells(1);
  Displacements displacements(10, Eigen::Vector2d(0, 0));
  displacements[4] = {0, -1};
  std::vector<Displacement> particles;
  add_cell(particles, grid, 0, displacements);
  FluctuationHistogram fluctuations;
  fluctuations.add(particles, grid);
  EXPECT_DOUBLE_EQ(fluctuations.bin_shares().back(), 0.1);
  EXPECT_DOUBLE_EQ(fluctuations.local_bin_shares().back(), 0.1);
}

}  // namespace
}  // namespace clca::measure::fluctuation_test
