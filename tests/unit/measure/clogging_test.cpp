// Which outlets particles at rest have clogged.

#include "clca/measure/clogging.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/states.hpp"

namespace clca::measure::clogging_test {
namespace {

using grains::State;
using lattice::Direction;
using lattice::Shape;

bool is_clogged(const State& state, std::size_t outlet = 0,
                Direction down = lattice::Direction::down) {
  return clogged(state, grains::Occupancy(state), outlet, down);
}

void add_wall(State& state, int left, int right, int bottom, int top) {
  grains::Wall wall;
  for (int column = left; column <= right; ++column) {
    for (int row = bottom; row <= top; ++row) {
      wall.sites.push_back({column, row});
    }
  }
  state.walls.push_back(wall);
}

/// A floor at row 10 with an orifice of columns 8 to 12, and an outlet under it.
State silo() {
  State state = testing::empty_state(20, 40);
  state.kinds = {{Shape::hexagon(2), 0}, {Shape::hexagon(0), 1}, {Shape::hexagon(3), 2}};
  add_wall(state, 0, 7, 10, 10);
  add_wall(state, 13, 19, 10, 10);
  state.outlets = {{.region = {0, 0, 30, 8}}};
  return state;
}

TEST(Clogged, OnlyWhenNoneCanFallFromAbove) {
  State state = silo();
  EXPECT_FALSE(is_clogged(state));  // empty
  state.particles = {{.column = 8, .row = 14}};
  EXPECT_FALSE(is_clogged(state));  // beside it is room
  state.particles.push_back({.column = 13, .row = 14});
  EXPECT_TRUE(is_clogged(state));
  EXPECT_FALSE(is_clogged(state, 0, Direction::up));
}

TEST(Clogged, NotByAHeapBesideTheOrifice) {
  State state = silo();
  // At rest on the floor, three high: the way down along their slope leads through the orifice.
  state.particles = {{.column = 2, .row = 13},
                     {.column = 2, .row = 18},
                     {.column = 2, .row = 23},
                     {.column = 17, .row = 13},
                     {.column = 17, .row = 18}};
  EXPECT_FALSE(is_clogged(state));
}

TEST(Clogged, AlsoBesideAnInsertThatCoversTheOrifice) {
  State state = silo();
  add_wall(state, 5, 15, 22, 23);
  EXPECT_FALSE(is_clogged(state));
  state.particles = {{.column = 2, .row = 20}};  // between the insert and the side of the box
  EXPECT_TRUE(is_clogged(state));                // though the other way is open
  state.particles.push_back({.column = 18, .row = 20});
  EXPECT_TRUE(is_clogged(state));
}

TEST(Clogged, NotByThoseThatTheOrificeIsTooNarrowFor) {
  State state = silo();
  state.particles = {{.column = 10, .row = 15, .kind = 2}};
  EXPECT_FALSE(is_clogged(state));
  state.particles.push_back({.column = 10, .row = 25, .kind = 1});  // which would pass
  EXPECT_TRUE(is_clogged(state));
  state.particles.back() = {.column = 0, .row = 11, .kind = 1};  // on the floor
  EXPECT_FALSE(is_clogged(state));
}

TEST(Clogged, IsSaidOfEachOutlet) {
  State state = testing::empty_state(40, 40);
  state.kinds = {{Shape::hexagon(2), 0}};
  add_wall(state, 0, 7, 10, 10);
  add_wall(state, 13, 27, 10, 10);
  add_wall(state, 33, 39, 10, 10);
  state.outlets = {{.region = {0, 0, 16, 8}}, {.region = {16, 0, 40, 8}}};
  state.particles = {{.column = 8, .row = 14}, {.column = 13, .row = 14}};
  EXPECT_TRUE(is_clogged(state, 0));
  EXPECT_FALSE(is_clogged(state, 1));
  EXPECT_THROW(is_clogged(state, 2), std::out_of_range);
}

}  // namespace
}  // namespace clca::measure::clogging_test
