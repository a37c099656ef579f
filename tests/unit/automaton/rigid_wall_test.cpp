// Walls that push: what goes along with them and what stops them.

#include <gtest/gtest.h>

#include "support/overlaps.hpp"
#include "support/wall_bench.hpp"

namespace clca::automaton::rigid_wall_test {
namespace {

using grains::Occupancy;
using grains::Particle;
using grains::PassiveRule;
using grains::State;
using grains::Wall;
using lattice::Axial;
using lattice::Direction;
using lattice::Shape;
using lattice::Site;
using testing::driven_wall;
using testing::empty_state;
using testing::particle_at;
using testing::WallBench;

/// Single sites in a narrow box.
State single_sites(std::vector<Particle> particles) {
  State state = empty_state(5, 6);
  state.kinds = {{Shape::hexagon(0), 0}};
  state.particles = std::move(particles);
  return state;
}

TEST(RigidWall, LiftsAHeapByExactlyOneRowAndLeavesWhatItsParticlesDid) {
  State state = testing::mixed_automaton(30, 60, 12).state();
  state.walls = {driven_wall(testing::whole_row(state, 0), Direction::up, PassiveRule::rigid)};
  for (Particle& particle : state.particles) {
    particle.row += 1;  // the box is far from full
  }
  Automaton settling(state);
  settling.set_wall_moving(0, false);
  testing::settle(settling);
  settling.set_wall_moving(0, true);
  State expected = settling.state();
  for (Particle& particle : expected.particles) {
    particle.row += 1;
    particle.previous = 3;
  }
  State start = settling.state();
  for (Particle& particle : start.particles) {
    particle.previous = 3;
  }
  WallBench bench(start);
  EXPECT_TRUE(bench.advance());
  EXPECT_EQ(bench.state.particles, expected.particles);
  EXPECT_EQ(bench.travel(0).offset, 1);
  EXPECT_EQ(Occupancy(bench.state), bench.world.occupancy);
}

TEST(RigidWall, LiftsAnOverhangAndItsRiderButNotWhatLiesBelowOrAside) {
  State state = empty_state(12, 20);
  state.kinds = {{Shape::hexagon(0), 0}, {Shape({{0, 0}, {1, 0}, {2, 0}}), 1}};
  state.walls = {driven_wall({{4, 4}}, Direction::up, PassiveRule::rigid)};
  // The beam covers (4, 5), (5, 5) and (6, 6).
  state.particles = {particle_at(4, 5, 1), particle_at(6, 7), particle_at(6, 5), particle_at(8, 8)};
  WallBench bench(state);
  bench.advance();
  EXPECT_EQ(bench.site(0), (Site{4, 6}));
  EXPECT_EQ(bench.site(1), (Site{6, 8}));
  EXPECT_EQ(bench.site(2), (Site{6, 5}));
  EXPECT_EQ(bench.site(3), (Site{8, 8}));
}

TEST(RigidWall, StallsAndChangesNothingWhenItsTrainMeetsTheLid) {
  State state = single_sites({particle_at(2, 1), particle_at(2, 2), particle_at(2, 3),
                              particle_at(2, 4), particle_at(2, 5)});
  state.walls = {driven_wall({{2, 0}}, Direction::up, PassiveRule::rigid)};
  state.step = 7;
  WallBench bench(state);
  EXPECT_FALSE(bench.advance());
  EXPECT_EQ(bench.travel(0).stalls, 1U);
  EXPECT_EQ(bench.travel(0).stalled_since, 7U);
  EXPECT_EQ(bench.state.particles, state.particles);
  EXPECT_EQ(Occupancy(state), bench.world.occupancy);
}

TEST(RigidWall, StallsWhenItsTrainMeetsAnyOtherWall) {
  const std::vector<Wall> others = {
      {.sites = {{2, 3}}},
      driven_wall({{2, 3}}, Direction::up, PassiveRule::rigid, 0),
      driven_wall({{2, 3}}, Direction::up, PassiveRule::overlap, 0),
  };
  for (const Wall& other : others) {
    State state = single_sites({particle_at(2, 1), particle_at(2, 2)});
    state.walls = {driven_wall({{2, 0}}, Direction::up, PassiveRule::rigid), other};
    WallBench bench(state);
    EXPECT_FALSE(bench.advance());
    EXPECT_EQ(bench.travel(0).stalls, 1U);
    EXPECT_EQ(bench.state.particles, state.particles);
  }
}

TEST(RigidWall, ThatIsGoneLetsTheNextOneByAndOneAtRestDoesNot) {
  for (const bool present : {true, false}) {
    State state = single_sites({});
    state.walls = {driven_wall({{2, 0}}, Direction::up, PassiveRule::rigid),
                   {.sites = {{2, 1}}, .present = present}};
    WallBench bench(state);
    EXPECT_EQ(bench.advance(), !present);
  }
}

TEST(RigidWall, PushesAChainAlongAnyDirectionAndNoBystander) {
  for (const bool periodic : {false, true}) {
    for (const Direction direction : lattice::kDirections) {
      State state = empty_state(20, 20);
      state.lattice = lattice::Lattice(20, 20, periodic);
      state.kinds = {{Shape::hexagon(0), 0}};
      const Axial one = unit(direction);
      Site site{10, 10};
      state.walls = {driven_wall({site}, direction, PassiveRule::rigid)};
      for (int i = 0; i < 3; ++i) {
        site = site + one;
        state.particles.push_back(particle_at(site.column, site.row));
      }
      const Site aside = Site{10, 10} + unit(rotated(direction, 2));
      state.particles.push_back(particle_at(aside.column, aside.row));
      WallBench bench(state);
      bench.advance();
      for (std::size_t id = 0; id < 3; ++id) {
        EXPECT_EQ(bench.site(id), state.particles[id].site() + one);
      }
      EXPECT_EQ(bench.site(3), aside);
      EXPECT_EQ(Occupancy(bench.state), bench.world.occupancy);
    }
  }
}

TEST(RigidWall, PushesAcrossThePeriodicSeamAllTheWayRound) {
  State state = empty_state(8, 20);
  state.lattice = lattice::Lattice(8, 20, true);
  state.kinds = {{Shape::hexagon(0), 0}};
  state.walls = {driven_wall({{7, 4}}, Direction::up_right, PassiveRule::rigid)};
  state.particles = {particle_at(8, 5), particle_at(9, 5)};  // in columns 0 and 1
  WallBench bench(state);
  for (int step = 1; step <= 16; ++step) {
    EXPECT_TRUE(bench.advance());
    EXPECT_EQ(bench.site(0).column, 8 + step);
    EXPECT_EQ(bench.site(1).column, 9 + step);
    EXPECT_EQ(Occupancy(bench.state), bench.world.occupancy);
  }
}

TEST(RigidWall, TakesAlongWhateverOverlapsWithItsTrain) {
  State state = empty_state(12, 20);
  // The second stands in the first, aside of the wall; the third stands in nobody.
  state.kinds = {{Shape({{0, -1}, {0, 0}, {0, 1}}), 0}, {Shape({{0, 0}, {1, 0}}), 1}};
  state.particles = {particle_at(4, 6), particle_at(4, 6, 1), particle_at(7, 6)};
  state.walls = {driven_wall({{4, 4}}, Direction::up, PassiveRule::rigid),
                 driven_wall({{9, 15}}, Direction::up, PassiveRule::overlap, 0)};
  state.pushes = {{.pushed = 1, .pusher = 0, .source = 1, .direction = Direction::up}};
  WallBench bench(state);
  bench.advance();
  EXPECT_EQ(bench.site(0), (Site{4, 7}));
  EXPECT_EQ(bench.site(1), (Site{4, 7}));
  EXPECT_EQ(bench.site(2), (Site{7, 6}));
  EXPECT_EQ(bench.state.pushes, state.pushes);
  EXPECT_EQ(Occupancy(bench.state), bench.world.occupancy);
}

TEST(RigidWall, ThatBeginsOutsideComesInAndThatGoesOutIsNotThere) {
  State state = single_sites({particle_at(2, 0)});
  state.walls = {driven_wall({{2, -2}, {2, -1}}, Direction::up, PassiveRule::rigid)};
  WallBench bench(state);
  for (int step = 1; step <= 5; ++step) {
    EXPECT_TRUE(bench.advance());
    EXPECT_EQ(bench.site(0), (Site{2, step}));
    EXPECT_EQ(current_sites(state.lattice, bench.state.walls[0]).size(), step == 1 ? 1U : 2U);
  }
  EXPECT_FALSE(bench.advance());  // the particle is at the lid
  EXPECT_EQ(bench.travel(0).stalls, 1U);
  grains::remove_particle(bench.box, 0);
  for (int step = 0; step < 3; ++step) {
    EXPECT_TRUE(bench.advance());
  }
  EXPECT_TRUE(current_sites(state.lattice, bench.state.walls[0]).empty());
  EXPECT_EQ(Occupancy(bench.state), bench.world.occupancy);
}

TEST(RigidWall, PushesIntoAnOutlet) {
  State state = empty_state(9, 12);
  state.kinds = {{Shape::hexagon(0), 0}};
  state.particles = {particle_at(4, 4)};  // rests between two sites of the wall
  state.walls = {driven_wall(testing::whole_row(state, 3), Direction::up, PassiveRule::rigid)};
  state.outlets = {{.region = {0, 5, 20, 8}}};
  Automaton automaton(state);
  const grains::StepReport report = automaton.step();
  EXPECT_EQ(report.moved_count, 0U);
  EXPECT_EQ(report.removed_count, 1U);
  EXPECT_EQ(automaton.state().outlets[0].particles, 1U);
  EXPECT_FALSE(automaton.state().particles[0].present);
}

TEST(RigidWall, CannotBeginInAnotherWall) {
  State state = single_sites({});
  state.walls = {{.sites = {{2, 2}}}, driven_wall({{2, 2}}, Direction::up, PassiveRule::rigid)};
  EXPECT_THROW(Automaton{state}, std::invalid_argument);
  state.walls[1].present = false;
  Automaton automaton(state);
  EXPECT_FALSE(automaton.insert_wall(1));
}

}  // namespace
}  // namespace clca::automaton::rigid_wall_test
