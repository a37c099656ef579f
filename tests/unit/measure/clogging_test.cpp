// Which outlets particles at rest have clogged.

#include <gtest/gtest.h>

#include <stdexcept>

#include "clca/measure/outflow.hpp"
#include "support/states.hpp"

namespace clca::measure::clogging_test {
namespace {

using grains::State;
using lattice::Direction;
using lattice::Shape;

bool is_clogged(const State& state, std::size_t outlet = 0,
                Direction down = lattice::Direction::down) {
  return measure::is_clogged(state, grains::Occupancy(state), outlet, down);
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

constexpr std::uint16_t kPoint = 1;  // a site
constexpr std::uint16_t kBlock = 2;  // thirteen columns
constexpr std::uint16_t kSmall = 3;  // three columns

/// A floor at row 10 with an orifice of columns 6 to 16, and an outlet under it.
State silo() {
  State state = testing::empty_state(24, 40);
  state.kinds = {{Shape::hexagon(2), 0},
                 {Shape::hexagon(0), 1},
                 {Shape::hexagon(6), 2},
                 {Shape::hexagon(1), 3}};
  add_wall(state, 0, 5, 10, 10);
  add_wall(state, 17, 23, 10, 10);
  state.outlets = {{.region = {0, 0, 30, 8}}};
  return state;
}

TEST(Clogged, ByAnArch) {
  State state = silo();
  EXPECT_FALSE(is_clogged(state));  // empty
  state.particles = {{.column = 5, .row = 14}, {.column = 15, .row = 14}};
  EXPECT_FALSE(is_clogged(state));  // another one would pass between them
  state.particles.push_back({.column = 10, .row = 14});
  EXPECT_TRUE(is_clogged(state));
  EXPECT_FALSE(is_clogged(state, 0, Direction::up));
}

TEST(Clogged, NotByAHeapBesideTheOrifice) {
  State state = silo();
  // At rest on the floor: the way down along their slope leads through the orifice.
  state.particles = {{.column = 2, .row = 13},
                     {.column = 2, .row = 18},
                     {.column = 2, .row = 23},
                     {.column = 20, .row = 13},
                     {.column = 20, .row = 18}};
  EXPECT_FALSE(is_clogged(state));
}

TEST(Clogged, AlsoBesideAnInsertThatCoversTheOrifice) {
  State state = silo();
  add_wall(state, 7, 15, 22, 23);
  state.particles = {{.column = 1, .row = 21, .kind = kSmall}};
  EXPECT_FALSE(is_clogged(state));  // there is room beside it
  state.particles.push_back({.column = 4, .row = 21, .kind = kSmall});
  EXPECT_TRUE(is_clogged(state));  // though on the other side of the insert nothing hangs
}

TEST(Clogged, AlsoByOneThatFillsTheWayBesideAnInsert) {
  State state = silo();
  add_wall(state, 5, 23, 22, 23);
  state.particles = {
      {.column = 2, .row = 21}};  // straight above the places beside it is the insert
  EXPECT_TRUE(is_clogged(state));
  state.particles = {{.column = 2, .row = 13}};  // on the floor
  EXPECT_FALSE(is_clogged(state));
}

TEST(Clogged, AlsoByAHeapBelowAHopperThatReachesUpToIt) {
  State state = testing::empty_state(25, 40);
  state.kinds = {{Shape::hexagon(2), 0}, {Shape::hexagon(5), 1}};
  grains::Wall hopper;
  for (int k = 0; k < 8; ++k) {
    for (const int row : {10 + k, 11 + k}) {
      hopper.sites.push_back({7 - k, row});
      hopper.sites.push_back({17 + k, row});
    }
  }
  state.walls = {hopper};
  state.outlets = {{.region = {0, 0, 30, 6}}};
  state.particles = {{.column = 12, .row = 30}};
  EXPECT_FALSE(is_clogged(state));
  state.particles.push_back({.column = 12, .row = 6, .kind = 1});  // too large for the outlet
  EXPECT_TRUE(is_clogged(state));
}

TEST(Clogged, NotByAHeapInAClosedBox) {
  State state = silo();
  add_wall(state, 0, 23, 35, 35);
  state.particles = {{.column = 2, .row = 13}, {.column = 20, .row = 13}};
  EXPECT_FALSE(is_clogged(state));
}

TEST(Clogged, NotByThoseThatTheOrificeIsTooNarrowFor) {
  State state = silo();
  state.particles = {{.column = 11, .row = 14, .kind = kBlock}};
  EXPECT_FALSE(is_clogged(state));
  state.particles.push_back({.column = 11, .row = 22, .kind = kPoint});  // which would pass
  EXPECT_TRUE(is_clogged(state));
  state.particles.back() = {.column = 0, .row = 11, .kind = kPoint};  // on the floor
  EXPECT_FALSE(is_clogged(state));
}

TEST(Clogged, WhereverTheReferenceSiteLies) {
  State state = testing::empty_state(24, 40);
  state.kinds = {{Shape::hexagon(6), 0}, {Shape({{6, -3}}), 1}};  // a site six columns to the right
  add_wall(state, 0, 9, 10, 10);
  add_wall(state, 11, 23, 10, 10);
  state.outlets = {{.region = {8.2, 0, 9.1, 8}}};  // column 10
  state.particles = {{.column = 10, .row = 17}, {.column = 4, .row = 25, .kind = 1}};
  EXPECT_TRUE(is_clogged(state));
}

TEST(Clogged, IsSaidOfEachOutlet) {
  State state = testing::empty_state(48, 40);
  state.kinds = {{Shape::hexagon(2), 0}};
  add_wall(state, 0, 5, 10, 10);
  add_wall(state, 17, 29, 10, 10);
  add_wall(state, 41, 47, 10, 10);
  state.outlets = {{.region = {0, 0, 20, 8}}, {.region = {20, 0, 42, 8}}};
  state.particles = {
      {.column = 5, .row = 14}, {.column = 10, .row = 14}, {.column = 15, .row = 14}};
  EXPECT_TRUE(is_clogged(state, 0));
  EXPECT_FALSE(is_clogged(state, 1));
  EXPECT_THROW(is_clogged(state, 2), std::out_of_range);
}

}  // namespace
}  // namespace clca::measure::clogging_test
