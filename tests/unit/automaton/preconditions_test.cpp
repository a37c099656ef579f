// What an automaton refuses to work with, rather than to go astray.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "clca/automaton/automaton.hpp"
#include "support/states.hpp"

namespace clca::automaton {
namespace {

/// Two species, a particle, a wall that moves, a source.
State good_state() {
  State state = testing::empty_state(40, 40);
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  state.particles = {testing::particle_at(10, 10)};
  state.walls = {{.sites = {{30, 30}},
                  .motion = Motion{.direction = lattice::Direction::down,
                                   .program = Drive{.period = 2, .distance = 5}}}};
  state.sources = {{.sites = {{20, 30}}, .weights = {1, 1}}};
  return state;
}

std::string refusal(const State& state, const Options& options = {}) {
  try {
    const Automaton automaton(state, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

std::string refusal_after(const std::function<void(State&)>& change) {
  State state = good_state();
  change(state);
  return refusal(state);
}

void set_motion(State& state, Motion motion) {
  state.walls[0].motion = std::move(motion);
}

TEST(AnAutomaton, TakesAStateWithWallsSourcesAndPushes) {
  EXPECT_EQ(refusal(good_state()), "");
  EXPECT_EQ(refusal(good_state(), {.threads = 3}), "");
}

TEST(AnAutomaton, RefusesNumbersOfThreadsThatAreNotPositive) {
  EXPECT_EQ(refusal(good_state(), {.threads = 0}), "the number of threads must be positive");
  EXPECT_EQ(refusal(good_state(), {.threads = -3}), "the number of threads must be positive");
}

TEST(AnAutomaton, RefusesAShapeWhoseReferenceSiteIsNotItsOwn) {
  EXPECT_EQ(refusal_after([](State& state) {
              state.kinds[0].shape = lattice::Shape({{50, 0}, {51, 0}});
            }),
            "the reference site of a kind is not one of its sites");
}

TEST(AnAutomaton, RefusesParticlesOfNoKindOrMove) {
  EXPECT_EQ(refusal_after([](State& state) { state.particles[0].kind = 2; }),
            "a particle is of no kind");
  EXPECT_EQ(refusal_after([](State& state) { state.particles[0].previous = 7; }),
            "a particle has moved nowhere");
  EXPECT_EQ(refusal_after([](State& state) {
              state.particles[0] = testing::particle_at(std::numeric_limits<int>::max(), 0);
            }),
            "a particle is too far away");
}

TEST(AnAutomaton, RefusesMotionsThatCannotBeCarriedOut) {
  const auto down = lattice::Direction::down;
  for (const Motion& motion :
       {Motion{down, Drive{.period = 0, .distance = 1}}, Motion{down, Drive{1, -1}},
        Motion{down, Wave{.amplitude = 1, .period = 0}}, Motion{down, Wave{.amplitude = -1}},
        Motion{down, Shake{.amplitude = -1, .wait = 1}}, Motion{down, Path{{{0, 1}}}},
        Motion{down, Path{{{4, 1}, {4, 2}}}},
        Motion{static_cast<lattice::Direction>(6), Drive{1, 1}}}) {
    EXPECT_EQ(refusal_after([&](State& state) { set_motion(state, motion); }),
              "the motion of a wall cannot be carried out");
  }
  EXPECT_EQ(refusal_after([](State& state) { state.walls[0].travel.offset = 6; }),
            "a wall is where its motion never comes to");
}

TEST(AnAutomaton, RefusesSourcesThatHaveNothingToDraw) {
  EXPECT_EQ(refusal_after([](State& state) { state.sources[0].sites.clear(); }),
            "a source has no sites");
  EXPECT_EQ(refusal_after([](State& state) { state.sources[0].weights = {1}; }),
            "a source has not one weight for each kind");
  EXPECT_EQ(refusal_after([](State& state) {
              state.sources[0].weights = {0, 0};
            }),
            "all weights of a source are 0");
}

TEST(AnAutomaton, RefusesPushesBetweenNobody) {
  const std::string nobody = "a push is between nobody";
  EXPECT_EQ(refusal_after([](State& state) { state.pushes = {{.pushed = 1, .pusher = 0}}; }),
            nobody);
  EXPECT_EQ(refusal_after([](State& state) { state.pushes = {{.pushed = 0, .pusher = 5}}; }),
            nobody);
  EXPECT_EQ(refusal_after([](State& state) {
              state.pushes = {{.pushed = 0, .pusher = kFirstWall, .source = 9}};
            }),
            nobody);
}

TEST(AnAutomaton, RefusesRulesOutOfRange) {
  EXPECT_NE(refusal_after([](State& state) { state.rules.inertia = 1.5; }), "");
  EXPECT_NE(refusal_after([](State& state) {
              state.rules.scatter = std::numeric_limits<double>::quiet_NaN();
            }),
            "");
  EXPECT_EQ(
      refusal_after([](State& state) { state.rules.gravity = static_cast<lattice::Direction>(9); }),
      "gravity has no direction");
  EXPECT_EQ(
      refusal_after([](State& state) { state.rules.update_priority[0] = UpdateClass::gravity; }),
      "the update priority does not name each class once");
}

TEST(AFill, NeedsOneCountForEachSpecies) {
  Automaton automaton(good_state());
  for (const std::vector<std::size_t>& counts : {std::vector<std::size_t>{}, {1}, {1, 1, 1}}) {
    EXPECT_THROW(automaton.fill({0, 0, 30, 30}, counts), std::invalid_argument);
    EXPECT_THROW(automaton.deposit({0, 0, 30, 30}, counts), std::invalid_argument);
  }
  const std::vector<std::size_t> counts = {1, 1};
  EXPECT_TRUE(automaton.fill({0, 0, 30, 30}, counts).complete) << "after what was refused";
}

TEST(AFill, NeedsARegionOfNumbers) {
  Automaton automaton(good_state());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> counts = {1, 1};
  EXPECT_THROW(automaton.fill({0, 0, nan, 30}, counts), std::invalid_argument);
  EXPECT_THROW(automaton.deposit({0, nan, 30, 30}, counts), std::invalid_argument);
}

TEST(WallsAndSources, ThatAreNotThereAreRefused) {
  Automaton automaton(good_state());
  EXPECT_THROW(automaton.remove_wall(1), std::out_of_range);
  EXPECT_THROW(automaton.insert_wall(1), std::out_of_range);
  EXPECT_THROW(automaton.set_motion(1, true), std::out_of_range);
  EXPECT_THROW(automaton.set_source(1, true), std::out_of_range);
  EXPECT_NO_THROW(automaton.step()) << "after what was refused";
}

}  // namespace
}  // namespace clca::automaton
