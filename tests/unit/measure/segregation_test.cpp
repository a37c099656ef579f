#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "clca/measure/mixing.hpp"
#include "support/states.hpp"

namespace clca::measure::segregation_test {
namespace {

using grains::State;
using lattice::Shape;
using testing::particle_at;

/// Small particles are one site (kind 0), large ones two (kind 1), giants three (kind 2).
State empty_bed(int columns, int rows) {
  State state = testing::empty_state(columns, rows);
  state.kinds = {
      {Shape({{0, 0}}), 0}, {Shape({{0, 0}, {0, 1}}), 1}, {Shape({{0, 0}, {0, 1}, {0, 2}}), 2}};
  return state;
}

/// Stacks particles in a column from `row` up: s small, l large, g giant, - a free site.
void stack(State& state, int column, int row, std::string_view pattern) {
  for (const char letter : pattern) {
    const auto kind = static_cast<std::uint16_t>(letter == 's' ? 0 : letter == 'l' ? 1 : 2);
    if (letter != '-') {
      state.particles.push_back(particle_at(column, row, kind));
    }
    row += letter == '-' ? 1 : kind + 1;
  }
}

State column_of(std::string_view pattern, int row = 0) {
  State state = empty_bed(1, 60);
  stack(state, 0, row, pattern);
  return state;
}

TEST(Segregation, IsOneForLargeOnSmallAndMinusOneTheOtherWayRound) {
  EXPECT_DOUBLE_EQ(segregation_index(column_of("ssssssssllll")).value(), 1);
  EXPECT_DOUBLE_EQ(segregation_index(column_of("llllssssssss")).value(), -1);
  EXPECT_DOUBLE_EQ(segregation_index(column_of("slsslsslssls")).value(), 0);
}

TEST(Segregation, DoesNotDependOnWhereTheFloorIs) {
  EXPECT_DOUBLE_EQ(segregation_index(column_of("ssssssssllll", 20)).value(), 1);
}

TEST(Segregation, ComparesTheLargestWithTheSmallest) {
  // Small at 0, giant at 3, large at 5.5; the sites 0 and 2 to 6 are 23/6 high in the mean.
  EXPECT_DOUBLE_EQ(segregation_index(column_of("s-gl")).value(), 3 / (23.0 / 6));
}

TEST(Segregation, IsNoneForOneSize) {
  EXPECT_FALSE(segregation_index(column_of("")).has_value());
  EXPECT_FALSE(segregation_index(column_of("sss")).has_value());
  State state = column_of("sl");
  state.kinds[1] = {Shape({{0, 0}}), 1};  // another species of the same size
  EXPECT_FALSE(segregation_index(state).has_value());
  state = column_of("ssl");
  state.particles[2].present = false;
  EXPECT_FALSE(segregation_index(state).has_value());
}

TEST(Lacey, IsZeroForSeparatedParticles) {
  State state = empty_bed(32, 32);  // 4 x 5 cells of 8 columns
  for (int column = 0; column < 32; ++column) {
    stack(state, column, 0, column < 8 ? "llllllll" : "sssssssssss");
  }
  EXPECT_NEAR(lacey_index(state, 7).value(), 0, 1e-12);
}

TEST(Lacey, IsOneOnTheAverageOverAllOrders) {
  State state = empty_bed(2, 20);  // cells are rows 0 to 9 and 10 to 19
  for (const int row : {0, 3, 6, 12, 15, 17}) {
    state.particles.push_back(particle_at(0, row));
  }
  state.particles.push_back(particle_at(1, 2));
  std::string order = "llsssss";
  std::sort(order.begin(), order.end());
  double sum = 0;
  int orders = 0;
  do {
    for (std::size_t id = 0; id < order.size(); ++id) {
      state.particles[id].kind = order[id] == 'l' ? 1 : 0;
    }
    sum += lacey_index(state, 10).value();
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(orders, 21);
  EXPECT_NEAR(sum / orders, 1, 1e-12);
}

TEST(Lacey, IsAsCountedByHand) {
  // Two cells of two: large and small in one, two small in the other. p = 1/4, s^2 = 1/16,
  // s0^2 = 3/16, sr^2 = 3/16 x 1/3 = 1/16.
  State state = empty_bed(2, 20);
  state.particles = {particle_at(0, 0, 1), particle_at(0, 5), particle_at(0, 12),
                     particle_at(0, 15)};
  EXPECT_NEAR(lacey_index(state, 10).value(), 1, 1e-12);
  // Two large in one cell: s^2 = s0^2 = 1/4.
  state.particles[1].kind = 1;
  EXPECT_NEAR(lacey_index(state, 10).value(), 0, 1e-12);
}

TEST(Lacey, IsNoneForOneSizeAndForLonelyParticles) {
  EXPECT_FALSE(lacey_index(column_of(""), 5).has_value());
  EXPECT_FALSE(lacey_index(column_of("ssss"), 5).has_value());
  EXPECT_FALSE(lacey_index(column_of("s---------l"), 5).has_value());
  EXPECT_TRUE(lacey_index(column_of("slslslsl"), 4).has_value());
  EXPECT_FALSE(lacey_index(column_of("slslslsl"), 3).has_value());  // no room for two of them
}

/// Three stacks of small particles, the last with a large one in it.
State intruded(std::string_view last, int row = 0) {
  State state = empty_bed(5, 60);
  stack(state, 0, row, "ssssssss");
  stack(state, 2, row, "ssssssss");
  stack(state, 4, row, last);
  return state;
}

TEST(Intruder, RisesFromZeroOnTheFloorToOneAtTheTop) {
  EXPECT_DOUBLE_EQ(intruder_height(intruded("lssssss")).value(), 0);
  EXPECT_DOUBLE_EQ(intruder_height(intruded("ssslsss")).value(), 3.0 / 6);
  EXPECT_DOUBLE_EQ(intruder_height(intruded("ssslsss", 20)).value(), 3.0 / 6);
  // On top the stack under it ends at 6: the mean surface is at 22/3.
  EXPECT_DOUBLE_EQ(intruder_height(intruded("ssssssl")).value(), 6 / (22.0 / 3 - 2));
  EXPECT_DOUBLE_EQ(intruder_height(intruded("ssssssssl")).value(), 8.0 / 6);
}

TEST(Intruder, IsNoneUnlessExactlyOneSpeciesHasExactlyOneParticle) {
  EXPECT_FALSE(intruder_height(intruded("ssssssss")).has_value());
  EXPECT_FALSE(intruder_height(intruded("sslssl")).has_value());
  EXPECT_FALSE(intruder_height(intruded("sslssg")).has_value());
  State state = intruded("sslssl");
  state.particles.back().present = false;
  EXPECT_TRUE(intruder_height(state).has_value());
}

TEST(Intruder, IsNoneInABedNoDeeperThanItself) {
  EXPECT_FALSE(intruder_height(column_of("l")).has_value());
  State state = column_of("l");
  state.particles.push_back(particle_at(0, 30));
  state.particles.push_back(particle_at(0, 1));
  EXPECT_TRUE(intruder_height(state).has_value());
  state.particles[1].row = 0;
  EXPECT_FALSE(intruder_height(state).has_value());
}

TEST(Lacey, DoesNotDependOnTheImageOfAGrain) {
  State state = empty_bed(70, 20);
  state.lattice = lattice::Lattice(70, 20, true);
  for (int column = 0; column < 70; ++column) {
    stack(state, column, 0, column < 17 || column % 3 == 0 ? "sl" : "ss");
  }
  const std::optional<double> index = lacey_index(state, 8);
  ASSERT_TRUE(index);
  for (int image = -40; image <= 40; ++image) {
    State moved = state;
    for (grains::Particle& particle : moved.particles) {
      particle.column += 70 * image;
    }
    EXPECT_EQ(lacey_index(moved, 8), index);
  }
}

}  // namespace
}  // namespace clca::measure::segregation_test
