// Stress on cells, of forces that are known.

#include "clca/measure/stress.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace clca::measure::stress_test {
namespace {

/// A hexagon of radius 1 on the floor, and one that stands on it.
grains::State column_of_two(bool periodic = false) {
  grains::State state{.lattice = lattice::Lattice(20, 20, periodic), .seed = 1};
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  return state;
}

contact::Force with_floor(const Eigen::Vector2d& place, const Eigen::Vector2d& branch,
                          double along_normal, double along_shear) {
  contact::Force force;
  force.other = contact::kFloor;
  force.point = place;
  force.normal = branch.normalized();
  force.branch = branch;
  force.along_normal = along_normal;
  force.along_shear = along_shear;
  return force;
}

TEST(StressField, AForceCountsByItsBranchOverTheArea) {
  const grains::State state = column_of_two();
  const Grid grid(state.lattice, 100);
  ASSERT_EQ(grid.size(), 1U);
  const std::vector forces = {with_floor({5, 0}, {0, 2}, 3, 1)};
  const auto cells = stress_field(state, forces, 100);
  ASSERT_EQ(cells.size(), 1U);
  const double area = grid.cell_area();
  EXPECT_DOUBLE_EQ(area, 20 * lattice::kColumnPitch * 20.5);
  EXPECT_NEAR(cells[0].yy, 3 * 2 / area, 1e-12);
  EXPECT_NEAR(cells[0].xy, -1 * 2 / 2.0 / area, 1e-12);
  EXPECT_NEAR(cells[0].xx, 0, 1e-12);
  EXPECT_NEAR(cells[0].pressure(), 3 / area, 1e-12);
}

TEST(StressField, CellsShareABranchThatCrossesThem) {
  const grains::State state = column_of_two();
  const std::vector forces = {with_floor({5, 0}, {0, 8}, 2, 0)};
  const auto cells = stress_field(state, forces, 4);
  const Grid grid(state.lattice, 4);
  const double whole = 2 * 8 / grid.cell_area();
  const double sum =
      std::accumulate(cells.begin(), cells.end(), 0.0,
                      [](double total, const StressCell& cell) { return total + cell.yy; });
  EXPECT_NEAR(sum, whole, 1e-12);
  EXPECT_NEAR(cells[grid.index({5, 1})].yy, whole * 3.6 / 8, whole / 32);
  EXPECT_GT(cells[grid.index({5, 5})].yy, cells[grid.index({5, 1})].yy);
}

TEST(StressField, WithoutForcesThereIsNone) {
  for (const StressCell& cell : stress_field(column_of_two(), {}, 4)) {
    EXPECT_EQ(cell.pressure(), 0);
  }
}

}  // namespace
}  // namespace clca::measure::stress_test
