// Walls that enter particles, and walls that come and go.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "support/overlaps.hpp"
#include "support/wall_bench.hpp"

namespace clca::automaton::overlap_wall_test {
namespace {

using grains::Occupancy;
using grains::Owner;
using grains::PassiveRule;
using grains::Path;
using grains::Push;
using grains::State;
using grains::Travel;
using grains::Wall;
using grains::wall_code;
using lattice::Direction;
using lattice::Shape;
using lattice::Site;
using testing::driven_wall;
using ::testing::ElementsAre;
using testing::empty_state;
using ::testing::IsEmpty;
using testing::particle_at;
using testing::WallBench;

constexpr Owner kWall = wall_code(0);

/// A hexagon under a single site that comes down.
State plate_over_hexagon() {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(4, 6)};
  state.walls = {driven_wall({{4, 8}}, Direction::down, PassiveRule::overlap)};
  return state;
}

Push push_of_wall(std::uint32_t pushed, Direction direction) {
  return {.pushed = pushed, .pusher = kWall, .source = 0, .direction = direction};
}

TEST(OverlapWall, EntersAParticleByOneSiteAndRecordsThePush) {
  WallBench bench(plate_over_hexagon());
  EXPECT_TRUE(bench.advance());
  const State& state = bench.state;
  EXPECT_THAT(state.pushes, ElementsAre(push_of_wall(0, Direction::down)));
  const std::size_t place = state.lattice.index({4, 7});
  EXPECT_EQ(bench.world.occupancy.owner(place), kWall);
  EXPECT_EQ(bench.world.occupancy.second_owner(place), 0);
  EXPECT_EQ(bench.site(0), (Site{4, 6}));
  EXPECT_EQ(testing::complaint(state), "");
}

TEST(OverlapWall, StallsAndIsUndoneWhereOneMoveCouldNotFreeTheParticle) {
  WallBench bench(plate_over_hexagon());
  bench.advance();
  const State before = bench.state;
  EXPECT_FALSE(bench.advance());  // it would stand in the centre
  EXPECT_EQ(bench.travel(0).stalls, 1U);
  EXPECT_EQ(bench.travel(0).stalled_since, 1U);
  EXPECT_EQ(bench.travel(0).offset, 1);
  EXPECT_EQ(bench.state.pushes, before.pushes);
  EXPECT_EQ(Occupancy(before), bench.world.occupancy);
}

TEST(OverlapWall, EntersNoSiteWithTwoOccupants) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape({{0, 0}, {0, 1}}), 0}};
  state.particles = {particle_at(4, 5), particle_at(4, 6)};  // both stand in (4, 6)
  state.walls = {driven_wall({{3, 5}}, Direction::up_right, PassiveRule::overlap)};
  state.pushes = {{.pushed = 0, .pusher = 1, .source = 0, .direction = Direction::down}};
  WallBench bench(state);
  EXPECT_FALSE(bench.advance());
  EXPECT_EQ(bench.travel(0).stalls, 1U);
  EXPECT_EQ(bench.state.pushes, state.pushes);
  EXPECT_EQ(Occupancy(state), bench.world.occupancy);
}

TEST(OverlapWall, EntersNoOtherWall) {
  for (const Wall& other :
       {Wall{.sites = {{4, 7}}}, driven_wall({{4, 7}}, Direction::up, PassiveRule::overlap, 0)}) {
    State state = plate_over_hexagon();
    state.particles.clear();
    state.walls.push_back(other);
    WallBench bench(state);
    EXPECT_FALSE(bench.advance());
    EXPECT_EQ(bench.travel(0).stalls, 1U);
  }
}

TEST(OverlapWall, ForgetsThePushWhenItGoesBack) {
  State state = plate_over_hexagon();
  state.walls[0].motion->program = Path{{{1, 1}, {2, 0}}};
  WallBench bench(state);
  bench.advance();
  EXPECT_EQ(bench.state.pushes.size(), 1U);
  bench.advance();
  EXPECT_THAT(bench.state.pushes, IsEmpty());
  EXPECT_FALSE(bench.world.is_overlapping(0));
  EXPECT_EQ(Occupancy(bench.state), bench.world.occupancy);
}

TEST(OverlapWall, ThatBeginsOutsideComesIn) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(4, 10)};
  state.walls = {driven_wall(testing::whole_row(state, 12), Direction::down, PassiveRule::overlap)};
  WallBench bench(state);
  EXPECT_THAT(current_sites(state.lattice, state.walls[0]), IsEmpty());
  EXPECT_TRUE(bench.advance());
  EXPECT_EQ(current_sites(state.lattice, bench.state.walls[0]).size(), 9U);
  EXPECT_THAT(bench.state.pushes, ElementsAre(push_of_wall(0, Direction::down)));
}

TEST(RemoveWall, OfAWallThatOverlapsForgetsItsPushesAndWakesWhomItPushed) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {particle_at(4, 6)};
  // Above and below at once: it can go nowhere.
  state.walls = {
      driven_wall(testing::whole_row(state, 8), Direction::down, PassiveRule::overlap, 1),
      {.sites = testing::whole_row(state, 4)}};
  Automaton automaton(state, {.gravity = Direction::up});
  automaton.step();
  automaton.step();
  ASSERT_EQ(automaton.state().pushes.size(), 1U);
  ASSERT_EQ(automaton.state().particles[0].site(), (Site{4, 6}));
  automaton.remove_wall(0);
  EXPECT_THAT(automaton.state().pushes, IsEmpty());
  EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
  EXPECT_EQ(automaton.step().moved_count, 1U);
  EXPECT_EQ(automaton.state().particles[0].site(), (Site{4, 7}));
}

TEST(InsertWall, IsRefusedWhereAParticleStands) {
  State state = plate_over_hexagon();
  state.walls[0] = {.sites = {{4, 6}}, .present = false};
  state.walls.push_back(driven_wall({{4, 5}}, Direction::up, PassiveRule::overlap));
  state.walls[1].present = false;
  Automaton automaton(state);
  EXPECT_FALSE(automaton.insert_wall(0));
  EXPECT_FALSE(automaton.insert_wall(1));
  EXPECT_EQ(automaton.state().walls, state.walls);
  EXPECT_EQ(Occupancy(state), automaton.occupancy());
}

TEST(InsertWall, OfAWallAtRestIsRefusedWhereAWallThatMovesStands) {
  State state = plate_over_hexagon();
  state.walls.push_back({.sites = {{4, 7}}, .present = false});
  WallBench bench(state);
  bench.advance();  // the wall and the particle now share (4, 7)
  Automaton automaton(bench.state);
  EXPECT_FALSE(automaton.insert_wall(1));
  EXPECT_FALSE(automaton.state().walls[1].present);
  EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
}

TEST(InsertWall, OfAWallThatMovesIsRefusedWhereAnyWallStands) {
  State state = plate_over_hexagon();
  state.walls[0].present = false;
  state.walls.push_back({.sites = {{4, 8}, {4, 9}}});
  Automaton automaton(state);
  EXPECT_FALSE(automaton.insert_wall(0));
  automaton.remove_wall(1);
  EXPECT_TRUE(automaton.insert_wall(0));
  EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
}

TEST(SetMotion, NeedsAWallThatHasAMotion) {
  State state = plate_over_hexagon();
  state.walls.push_back({.sites = {{0, 0}}});
  Automaton automaton(state);
  EXPECT_THROW(automaton.set_wall_moving(1, true), std::invalid_argument);
  EXPECT_THROW(automaton.set_wall_moving(2, true), std::out_of_range);
  automaton.set_wall_moving(0, false);
  for (int step = 0; step < 3; ++step) {
    automaton.step();
  }
  EXPECT_EQ(automaton.state().walls[0].travel.clock, 0U);
  EXPECT_EQ(automaton.state().walls[0].travel.offset, 0);
  automaton.set_wall_moving(0, true);
  automaton.step();
  EXPECT_EQ(automaton.state().walls[0].travel.offset, 1);
}

TEST(State, EqualityAndHashCoverTravelAndPushes) {
  State state = plate_over_hexagon();
  state.pushes = {push_of_wall(0, Direction::down)};
  std::set<std::uint64_t> hashes = {hash(state)};
  const auto changed = [&](auto change) {
    State copy = state;
    change(copy);
    EXPECT_FALSE(copy == state);
    hashes.insert(hash(copy));
  };
  changed([](State& s) { s.walls[0].travel.active = false; });
  changed([](State& s) { s.walls[0].travel.offset = -1; });
  changed([](State& s) { s.walls[0].travel.clock = 1; });
  changed([](State& s) { s.walls[0].travel.phase = Travel::Phase::falling; });
  changed([](State& s) { s.walls[0].travel.waited = 1; });
  changed([](State& s) { s.walls[0].travel.cycles = 1; });
  changed([](State& s) { s.walls[0].travel.stalls = 1; });
  changed([](State& s) { s.walls[0].travel.stalled_since = 0; });
  changed([](State& s) { s.pushes.clear(); });
  changed([](State& s) { s.pushes[0].pushed = 1; });
  changed([](State& s) { s.pushes[0].pusher = 1; });
  changed([](State& s) { s.pushes[0].source = 1; });
  changed([](State& s) { s.pushes[0].direction = Direction::up; });
  EXPECT_EQ(hashes.size(), 14U);
}

}  // namespace
}  // namespace clca::automaton::overlap_wall_test
