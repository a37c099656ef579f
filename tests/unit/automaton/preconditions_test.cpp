// What an automaton refuses to work with, rather than to go astray.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "clca/automaton/automaton.hpp"
#include "support/states.hpp"

namespace clca::automaton::preconditions_test {
namespace {

using testing::good_state;

std::string refusal(const grains::State& state, const Rules& rules = {},
                    const Options& options = {}) {
  try {
    const Automaton automaton(state, rules, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(AnAutomaton, TakesAStateWithWallsSourcesAndPushes) {
  EXPECT_EQ(refusal(good_state()), "");
  EXPECT_EQ(refusal(good_state(), {}, {.threads = 3}), "");
}

TEST(AnAutomaton, RefusesNumbersOfThreadsThatAreNotPositive) {
  EXPECT_EQ(refusal(good_state(), {}, {.threads = 0}), "the number of threads must be positive");
  EXPECT_EQ(refusal(good_state(), {}, {.threads = -3}), "the number of threads must be positive");
}

TEST(AnAutomaton, RefusesAStateThatIsNotValid) {
  grains::State state = good_state();
  state.particles[0].kind = 2;
  EXPECT_EQ(refusal(state), "a particle is of no kind");
}

TEST(AnAutomaton, RefusesRulesOutOfRange) {
  EXPECT_NE(refusal(good_state(), {.inertia = 1.5}), "");
  EXPECT_NE(refusal(good_state(), {.scatter = std::numeric_limits<double>::quiet_NaN()}), "");
  EXPECT_EQ(refusal(good_state(), {.gravity = static_cast<lattice::Direction>(9)}),
            "gravity has no direction");
  using enum UpdateClass;
  EXPECT_EQ(refusal(good_state(), {.update_priority = {gravity, inertia, gravity}}),
            "the update priority does not name each class once");
}

TEST(AFill, NeedsOneCountForEachSpecies) {
  Automaton automaton(good_state());
  for (const std::vector<std::size_t>& counts : {std::vector<std::size_t>{}, {1}, {1, 1, 1}}) {
    EXPECT_THROW(automaton.fill({0, 0, 30, 30}, counts), std::invalid_argument);
    EXPECT_THROW(automaton.fill({0, 0, 30, 30}, counts, true), std::invalid_argument);
  }
  const std::vector<std::size_t> counts = {1, 1};
  EXPECT_TRUE(automaton.fill({0, 0, 30, 30}, counts).complete) << "after what was refused";
}

TEST(AFill, NeedsARegionOfNumbers) {
  Automaton automaton(good_state());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> counts = {1, 1};
  EXPECT_THROW(automaton.fill({0, 0, nan, 30}, counts), std::invalid_argument);
  EXPECT_THROW(automaton.fill({0, nan, 30, 30}, counts, true), std::invalid_argument);
}

TEST(WallsAndSources, ThatAreNotThereAreRefused) {
  Automaton automaton(good_state());
  EXPECT_THROW(automaton.remove_wall(1), std::out_of_range);
  EXPECT_THROW(automaton.insert_wall(1), std::out_of_range);
  EXPECT_THROW(automaton.set_wall_moving(1, true), std::out_of_range);
  EXPECT_THROW(automaton.set_source_open(1, true), std::out_of_range);
  EXPECT_NO_THROW(automaton.step()) << "after what was refused";
}

}  // namespace
}  // namespace clca::automaton::preconditions_test
