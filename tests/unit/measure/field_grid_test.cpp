#include "clca/measure/field_grid.hpp"

#include <gtest/gtest.h>

#include "support/states.hpp"

namespace clca::measure::field_grid_test {
namespace {

using grains::State;
using lattice::kColumnPitch;
using lattice::Shape;
using testing::particle_at;

/// Kind 0 is one site, kind 1 two.
State bed(int columns, int rows) {
  State state = testing::empty_state(columns, rows);
  state.kinds = {{Shape({{0, 0}}), 0}, {Shape({{0, 0}, {0, 1}}), 1}};
  return state;
}

TEST(Grid, FillsTheBoxWithCellsNearTheWishedSize) {
  const lattice::Lattice lattice(10, 10, false);  // 8.66 by 10.5 spacings
  const Grid grid(lattice, 3);
  EXPECT_EQ(grid.columns(), 3U);
  EXPECT_EQ(grid.rows(), 4U);
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    EXPECT_EQ(grid.cell_at(grid.cell_centre(cell)), cell);
  }
  EXPECT_EQ(grid.cell_at(lattice::position(lattice::Site{0, 0})), 0U);
  EXPECT_EQ(grid.cell_at(lattice::position(lattice::Site{9, 0})), 2U);
  EXPECT_EQ(grid.cell_at(lattice::position(lattice::Site{9, 9})), 11U);
  EXPECT_EQ(Grid(lattice, 1000).size(), 1U);
}

TEST(Grid, RunsOnAcrossASeam) {
  const Grid grid(lattice::Lattice(10, 10, true), 3);
  const Eigen::Vector2d point(1, 5);
  EXPECT_EQ(grid.cell_at(point + Eigen::Vector2d(30 * kColumnPitch, 0)), grid.cell_at(point));
  EXPECT_EQ(grid.cell_at(point - Eigen::Vector2d(10 * kColumnPitch, 0)), grid.cell_at(point));
}

// 70 columns in 8 cells: columns 17 and 52 stand on an edge (2 * 17 + 1 = 2 * 8.75 * 2).
TEST(Grid, AnEdgeBelongsToTheRightAndTheUpperCellInEveryImage) {
  State state = testing::empty_state(70, 60);
  state.lattice = lattice::Lattice(70, 60, true);
  state.kinds = {{Shape::hexagon(2), 0}};
  const Grid grid(state.lattice, 8);
  ASSERT_EQ(grid.columns(), 8U);
  for (int image = -200; image <= 200; ++image) {
    for (int column = 0; column < 70; ++column) {
      const auto cell = static_cast<std::size_t>((2 * column + 1) * 8 / (2 * 70));
      const grains::Particle particle = particle_at(column + 70 * image, 0);
      EXPECT_EQ(grid.cell_at(grains::centre_in_box(state, particle)), cell);
      EXPECT_EQ(grid.cell_at(grains::centre(state, particle)), cell);
    }
  }
  const Grid rows(lattice::Lattice(4, 20, false), 4.1);  // 20.5 in 5 cells
  EXPECT_EQ(rows.cell_at({0, 3 * 4.1 - 0.5}) / rows.columns(), 3U);
}

TEST(Grid, APathIsDividedAtTheEdgesOfCells) {
  const Grid grid(lattice::Lattice(10, 10, true), 3);
  const double high = 10.5 / 4;
  const Eigen::Vector2d from(0, -0.5 + high / 2);
  const auto up = grid.path_parts(from, {0, 2 * high});
  ASSERT_EQ(up.size(), 3U);
  for (std::size_t part = 0; part < 3; ++part) {
    EXPECT_EQ(up[part].cell, 3 * part);
    EXPECT_NEAR(up[part].share, part == 1 ? 0.5 : 0.25, 1e-12);
  }
  const auto left = grid.path_parts(from, {-kColumnPitch, 0});
  ASSERT_EQ(left.size(), 2U);
  EXPECT_EQ(left[0].cell, 0U);
  EXPECT_EQ(left[1].cell, 2U);  // across the seam
  EXPECT_NEAR(left[0].share, 0.5, 1e-12);
}

TEST(Fields, WeightMeansBySites) {
  State state = bed(6, 20);
  state.particles = {particle_at(2, 2, 1), particle_at(2, 10)};
  const Snapshot window(state);
  state.step += 2;
  state.particles[0].row += 2;  // two sites at 1 site per step up, one at 2 down
  state.particles[1].row -= 4;
  const std::vector<FieldCell> cells = field_cells(window, state, 100);
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells[0].particles, 2U);
  EXPECT_NEAR(cells[0].velocity.norm(), 0, 1e-12);
  EXPECT_NEAR(cells[0].fluctuation, 0.5 * (2 * 1 + 1 * 4) / 3, 1e-12);
  EXPECT_NEAR(cells[0].packing_fraction, 3.0 / 120, 1e-12);
}

TEST(Fields, BinByThePlaceAtTheBegin) {
  State state = bed(2, 20);  // cells: rows 0 to 9, rows 10 to 19
  state.particles = {particle_at(0, 2)};
  const Snapshot window(state);
  state.step += 10;
  state.particles[0].row = 17;
  const std::vector<FieldCell> cells = field_cells(window, state, 10);
  ASSERT_EQ(cells.size(), 2U);
  EXPECT_EQ(cells[0].particles, 1U);
  EXPECT_NEAR(cells[0].velocity.y(), 1.5, 1e-12);
  EXPECT_EQ(cells[1].particles, 0U);
  EXPECT_EQ(cells[0].packing_fraction, 0);
  EXPECT_GT(cells[1].packing_fraction, 0);  // the packing is of now
}

TEST(Fields, LeaveOutWhatCameOrLeft) {
  State state = bed(6, 20);
  state.particles = {particle_at(2, 2), particle_at(2, 10)};
  const Snapshot window(state);
  state.step += 1;
  state.particles[0].row += 1;
  state.particles[1].present = false;
  state.particles.push_back(particle_at(4, 4));
  const std::vector<FieldCell> cells = field_cells(window, state, 100);
  EXPECT_EQ(cells[0].particles, 1U);
  EXPECT_NEAR(cells[0].velocity.y(), 1, 1e-12);
  EXPECT_NEAR(cells[0].packing_fraction, 2.0 / 120, 1e-12);
}

TEST(Fields, ADriftOfAllHasNoFluctuationAndRunsOnAcrossASeam) {
  State state = bed(12, 20);
  state.lattice = lattice::Lattice(12, 20, true);
  for (int column = 0; column < 12; ++column) {
    state.particles.push_back(particle_at(column, 5));
  }
  const Snapshot window(state);
  state.step += 3;
  for (grains::Particle& particle : state.particles) {
    const lattice::Site moved = particle.site() + lattice::Axial{6, 0};
    particle.column = moved.column;
    particle.row = moved.row;
  }
  const std::vector<FieldCell> cells = field_cells(window, state, 4);
  for (const FieldCell& cell : cells) {
    if (cell.particles > 0) {
      EXPECT_TRUE(cell.velocity.isApprox(Eigen::Vector2d(2 * kColumnPitch, 1)));
    }
  }
  EXPECT_NEAR(mean_fluctuation(cells), 0, 1e-20);
}

TEST(Fields, AWindowOfNoStepsHasNoVelocityAndASharedSiteCountsOnce) {
  State state = bed(6, 20);
  state.particles = {particle_at(2, 2, 1), particle_at(2, 3, 1)};
  const std::vector<FieldCell> cells = field_cells(Snapshot(state), state, 100);
  EXPECT_EQ(cells[0].velocity.norm(), 0);
  EXPECT_EQ(cells[0].fluctuation, 0);
  EXPECT_NEAR(cells[0].packing_fraction, 3.0 / 120, 1e-12);
}

TEST(Fields, TheEnergyIsTheMeanOverParticles) {
  EXPECT_DOUBLE_EQ(mean_fluctuation({{{.particles = 1, .fluctuation = 4}},
                                     {{.particles = 3, .fluctuation = 0}},
                                     {{.particles = 0, .fluctuation = 100}}}),
                   1);
  EXPECT_EQ(mean_fluctuation({}), 0);
}

TEST(Fields, ConserveParticlesAndMomentum) {
  automaton::Automaton automaton = testing::mixed_automaton(60, 80, 40);
  const State before = automaton.state();
  const Snapshot window(before);
  for (int step = 0; step < 5; ++step) {
    automaton.step();
  }
  const State& after = automaton.state();
  Eigen::Vector2d momentum = Eigen::Vector2d::Zero();
  double mass = 0;
  for (std::size_t id = 0; id < after.particles.size(); ++id) {
    const auto sites = static_cast<double>(after.shape(after.particles[id]).size());
    momentum +=
        sites * lattice::position(after.particles[id].site() - before.particles[id].site()) / 5;
    mass += sites;
  }
  EXPECT_LT(momentum.y(), 0);
  EXPECT_TRUE(field_cells(window, after, 1000)[0].velocity.isApprox(momentum / mass));
  for (const double cell : {3.0, 7.0, 1000.0}) {
    double particles = 0;
    const std::vector<FieldCell> cells = field_cells(window, after, cell);
    for (const FieldCell& each : cells) {
      particles += each.particles;
      EXPECT_GE(each.packing_fraction, 0);
      EXPECT_LE(each.packing_fraction, 1);
      EXPECT_GE(each.fluctuation, 0);
    }
    EXPECT_EQ(particles, grains::present_count(after));
  }
  EXPECT_GT(mean_fluctuation(field_cells(window, after, 1000)), 0);
}

}  // namespace
}  // namespace clca::measure::field_grid_test
