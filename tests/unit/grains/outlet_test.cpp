#include <gtest/gtest.h>

#include "grains/internal/box.hpp"
#include "support/states.hpp"

namespace clca::grains::outlet_test {
namespace {

using testing::particle_at;

/// A hexagon inside both outlets, one that leaves them by a site, one that was taken away inside.
State three_at_outlets() {
  State state = testing::empty_state(20, 40);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  state.particles = {particle_at(4, 2), particle_at(4, 6), particle_at(10, 2)};
  state.particles[2].present = false;
  state.outlets = {{.region = {0, 0, 15, 7}}, {.region = {0, 0, 15, 6}}};
  return state;
}

TEST(CountAtOutlet, CountsAParticleThatLiesWhollyInsideAtTheFirstOne) {
  State state = three_at_outlets();
  EXPECT_TRUE(count_at_outlet(state, 0));
  EXPECT_EQ(state.outlets[0].particles, 1U);
  EXPECT_EQ(state.outlets[0].sites, 7U);
  EXPECT_EQ(state.outlets[1].particles, 0U);
  EXPECT_TRUE(state.particles[0].present) << "to take it away is left to the caller";
}

TEST(CountAtOutlet, ChangesNothingForOneThatLiesPartlyOutsideOrIsGone) {
  State state = three_at_outlets();
  const State before = state;
  EXPECT_FALSE(count_at_outlet(state, 1));
  EXPECT_FALSE(count_at_outlet(state, 2));
  EXPECT_EQ(state, before);
}

}  // namespace
}  // namespace clca::grains::outlet_test
