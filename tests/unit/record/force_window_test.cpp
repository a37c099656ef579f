#include <gtest/gtest.h>

#include "record/internal/contact_record.hpp"

namespace clca::record::force_window_test {
namespace {

/// How many steps the window holds after so many, in which the force is the number of the step.
double steps_held(std::uint64_t most, int steps) {
  ForceWindow window;
  for (int step = 1; step <= steps; ++step) {
    window.add({{.normal = Eigen::Vector2d::UnitY(), .normal_force = static_cast<double>(step)}}, 1,
               most);
  }
  return 2 * (steps - window.means(1).at(0).normal_force) + 1;
}

TEST(ForceWindow, HoldsTheLastHalfToWholeOfItsSteps) {
  for (const std::uint64_t most : {1U, 2U, 3U, 4U, 5U, 9U, 100U}) {
    const auto whole = static_cast<double>(most);
    EXPECT_EQ(steps_held(most, static_cast<int>(most)), whole);
    for (int steps = static_cast<int>(most) + 1; steps < 300; ++steps) {
      const double held = steps_held(most, steps);
      EXPECT_GE(held, std::floor(whole / 2)) << most << " " << steps;
      EXPECT_LE(held, whole) << most << " " << steps;
    }
  }
}

}  // namespace
}  // namespace clca::record::force_window_test
