// Stress on cells, of forces that are known.

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "clca/contact/contact_model.hpp"
#include "clca/measure/field_grid.hpp"

namespace clca::measure::stress_test {
namespace {

/// A hexagon of radius 1 on the floor, and one that stands on it.
grains::State column_of_two(bool periodic = false) {
  grains::State state{.lattice = lattice::Lattice(20, 20, periodic), .seed = 1};
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  return state;
}

contact::Force with_floor(const Eigen::Vector2d& place, const Eigen::Vector2d& branch,
                          double normal_force, double shear_force) {
  contact::Force force;
  force.other = contact::kFloor;
  force.point = place;
  force.normal = branch.normalized();
  force.branch = branch;
  force.normal_force = normal_force;
  force.shear_force = shear_force;
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
  EXPECT_NEAR(cells[grid.cell_at({5, 1})].yy, whole * 3.6 / 8, whole / 32);
  EXPECT_GT(cells[grid.cell_at({5, 5})].yy, cells[grid.cell_at({5, 1})].yy);
}

TEST(StressField, WithoutForcesThereIsNone) {
  for (const StressCell& cell : stress_field(column_of_two(), {}, 4)) {
    EXPECT_EQ(cell.pressure(), 0);
  }
}

/// Grains thrown into a box or, with `walls`, between four walls that line it.
contact::State thrown(bool walls, bool rods) {
  const lattice::Lattice lattice(40, 40, false);
  grains::State state{.lattice = lattice, .seed = 7};
  state.kinds = {{lattice::Shape::hexagon(1), 0},
                 {rods ? lattice::Shape::rod(0, 6) : lattice::Shape::hexagon(2), 1}};
  if (walls) {
    const double width = lattice.extent().x();
    for (const lattice::Rectangle& place :
         {lattice::Rectangle{-1, 3, 2, 36}, lattice::Rectangle{width - 3, 3, width, 36},
          lattice::Rectangle{-1, -1, width, 3}, lattice::Rectangle{-1, 36, width, 41}}) {
      state.walls.push_back({.sites = sites_in(lattice, place)});
    }
  }
  return {.grains = std::move(state)};
}

struct SideForces {
  double left = 0;
  double right = 0;
  double floor = 0;
  double top = 0;
};

/// Of the forces on the sides or the walls at them: what presses outwards.
SideForces outwards(const std::vector<contact::Force>& forces) {
  SideForces sums;
  for (const contact::Force& force : forces) {
    switch (force.other) {
      case contact::kLeftSide:
      case grains::wall_code(0):
        sums.left += force.on_upper().x();
        break;
      case contact::kRightSide:
      case grains::wall_code(1):
        sums.right -= force.on_upper().x();
        break;
      case contact::kFloor:
      case grains::wall_code(2):
        sums.floor += force.on_upper().y();
        break;
      case contact::kCeiling:
      case grains::wall_code(3):
        sums.top -= force.on_upper().y();
        break;
      default:
        break;
    }
  }
  return sums;
}

TEST(StressField, TheCellsAtTheSidesCarryTheForceOnThemAndOnWallsThere) {
  for (const bool walls : {false, true}) {
    for (const bool rods : {false, true}) {
      for (const double tilt : {0.0, 90.0, -90.0, 180.0, 40.0}) {
        const contact::Parameters parameters = {
            .rolling = rods ? contact::Rolling::none : contact::Rolling::free,
            .resolution = 0.2,
            .fall_height = 20};
        contact::ContactModel model(thrown(walls, rods), parameters);
        model.set_vessel(contact::Vessel{.angle = contact::angle_from_degrees(tilt)});
        model.fill({2, 3, 31, 36}, std::array<std::size_t, 2>{25, 15});
        for (int step = 0; step < 300; ++step) {
          model.step();
        }
        const grains::State& state = model.grains();
        const auto forces = contact::forces(model.state(), contact::gravity(parameters));
        const SideForces expected = outwards(forces);
        EXPECT_GT(expected.left + expected.right + expected.floor + expected.top, 20);
        // So that no centre of a grain lies in a cell at a side.
        for (const double cell : {0.4, rods ? 0.3 : 1.0}) {
          const Grid grid(state.lattice, cell);
          const auto cells = stress_field(state, forces, cell);
          const double width = state.lattice.extent().x() / static_cast<double>(grid.columns());
          const double height = state.lattice.extent().y() / static_cast<double>(grid.rows());
          SideForces found;
          for (std::size_t i = 0; i < cells.size(); ++i) {
            found.left += i % grid.columns() == 0 ? cells[i].xx * height : 0;
            found.right += i % grid.columns() == grid.columns() - 1 ? cells[i].xx * height : 0;
            found.floor += i / grid.columns() == 0 ? cells[i].yy * width : 0;
            found.top += i / grid.columns() == grid.rows() - 1 ? cells[i].yy * width : 0;
          }
          const std::string when = ::testing::PrintToString(std::array{tilt, cell, 0.0 + walls});
          EXPECT_NEAR(found.left, expected.left, 1e-6) << when;
          EXPECT_NEAR(found.right, expected.right, 1e-6) << when;
          EXPECT_NEAR(found.floor, expected.floor, 1e-6) << when;
          EXPECT_NEAR(found.top, expected.top, 1e-6) << when;
        }
      }
    }
  }
}

TEST(StressField, AWallInTheOpenCarriesAForceToItsFarSideOnly) {
  grains::State state = column_of_two();
  state.walls = {{.sites = sites_in(state.lattice, {0, 8, 15, 10})}};
  state.particles = {{.column = 6, .row = 11}};
  contact::Force force = with_floor({6 * lattice::kColumnPitch, 9.6}, {0, 1.4}, 3, 0);
  force.other = grains::wall_code(0);
  const auto cells = stress_field(state, std::vector{force}, 1);
  const Grid grid(state.lattice, 1);
  const double width = state.lattice.extent().x() / static_cast<double>(grid.columns());
  const auto carried = [&](double y) {
    return width * cells[grid.cell_at({6 * lattice::kColumnPitch, y})].yy;
  };
  EXPECT_NEAR(carried(10), 3, 1e-9);
  EXPECT_NEAR(carried(8.3), 3, 1e-9);
  EXPECT_EQ(carried(6), 0);
}

}  // namespace
}  // namespace clca::measure::stress_test
