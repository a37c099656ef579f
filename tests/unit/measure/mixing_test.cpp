#include "clca/measure/mixing.hpp"

#include <gtest/gtest.h>

#include "support/states.hpp"

namespace clca::measure::mixing_test {
namespace {

using lattice::Direction;
using testing::particle_at;

/// Grains of one site: 1.05 spacings in diameter, neighbours up to 1.42, and later up to 1.56.
grains::State grains_at(lattice::Lattice lattice, const std::vector<lattice::Site>& sites) {
  grains::State state{.lattice = lattice};
  state.kinds = {{lattice::Shape::hexagon(0), 0}};
  for (const lattice::Site site : sites) {
    state.particles.push_back(particle_at(site.column, site.row));
    state.origins.push_back(site);
  }
  return state;
}

/// A step in which each grain goes in its direction.
void step(grains::State& state, const std::vector<Direction>& directions) {
  for (std::size_t id = 0; id < directions.size(); ++id) {
    const lattice::Site to = state.particles[id].site() + unit(directions[id]);
    state.particles[id].column = to.column;
    state.particles[id].row = to.row;
  }
  ++state.step;
}

/// Two pairs of neighbours, one above the other, far apart.
grains::State two_pairs() {
  return grains_at(lattice::Lattice(20, 20, false), {{4, 10}, {4, 11}, {12, 10}, {12, 11}});
}

TEST(Mixing, FollowsThoseThatTouchOnly) {
  const grains::State row =
      grains_at(lattice::Lattice(20, 20, false), {{4, 10}, {4, 11}, {4, 12}, {6, 10}});
  const Mixing mixing(row);
  EXPECT_NEAR(mixing.mean_diameter(), 1.05, 0.0001);
  ASSERT_EQ(mixing.pairs().size(), 2);  // of the column: (6, 10) is 1.73 away from the first
  EXPECT_EQ(mixing.pairs()[0].second, 1);
  EXPECT_EQ(mixing.pairs()[1].second, 2);
}

TEST(Mixing, CountsEachPairOnceWhereItHasFallenByADiameter) {
  grains::State state = two_pairs();
  Mixing mixing(state);
  step(state, {Direction::down, Direction::down, Direction::down, Direction::down});
  mixing.add(state);
  EXPECT_TRUE(mixing.fallen_pairs().empty());  // by 1, less than 1.05
  // The first two part by 2 x 0.866 in x, and are 2 apart; the others stay together.
  step(state, {Direction::down_left, Direction::down_right, Direction::down, Direction::down});
  mixing.add(state);
  mixing.add(state);
  ASSERT_EQ(mixing.fallen_pairs().size(), 1);
  const FallenPairs& row = mixing.fallen_pairs().front();
  EXPECT_EQ(row.pairs, 2);
  EXPECT_EQ(row.kept, 1);
  EXPECT_DOUBLE_EQ(row.kept_share(), 0.5);
  EXPECT_DOUBLE_EQ(row.fallen, 1.5 + 2);
  EXPECT_NEAR(row.diffusion(), 3 / (4 * 3.5), 1e-12);
}

TEST(Mixing, TakesTheNearestImageInAPeriodicBox) {
  grains::State state = grains_at(lattice::Lattice(10, 20, true), {{0, 10}, {9, 10}});
  Mixing mixing(state);
  ASSERT_EQ(mixing.pairs().size(), 1);
  // Both go to the left, the first across the boundary: its column is -3 in the end.
  step(state, {Direction::down_left, Direction::down_left});
  step(state, {Direction::down_left, Direction::down_left});
  step(state, {Direction::down_left, Direction::down_left});
  mixing.add(state);
  ASSERT_EQ(mixing.fallen_pairs().size(), 1);
  EXPECT_EQ(mixing.fallen_pairs().front().kept, 1);
  EXPECT_EQ(mixing.fallen_pairs().front().spread, 0);
}

TEST(Mixing, EndsAPairWithTheRemovalOfOne) {
  grains::State state = two_pairs();
  Mixing mixing(state);
  state.particles[0].present = false;
  step(state, {Direction::down, Direction::down, Direction::down, Direction::down});
  step(state, {Direction::down, Direction::down, Direction::down, Direction::down});
  mixing.add(state);
  ASSERT_EQ(mixing.fallen_pairs().size(), 1);
  EXPECT_EQ(mixing.fallen_pairs().front().pairs, 1);
}

TEST(Mixing, OfAnEmptyBoxHasNoPairs) {
  grains::State state = grains_at(lattice::Lattice(10, 20, false), {});
  Mixing mixing(state);
  mixing.add(state);
  EXPECT_TRUE(mixing.pairs().empty());
  EXPECT_TRUE(mixing.fallen_pairs().empty());
}

TEST(Mixing, RefusesAStateOfAnotherRun) {
  grains::State state = two_pairs();
  Mixing mixing(state);
  EXPECT_THROW(mixing.add(grains_at(lattice::Lattice(10, 20, false), {})), std::invalid_argument);
}

}  // namespace
}  // namespace clca::measure::mixing_test
