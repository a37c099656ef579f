// Convection in a shaken box: up inside, down along the walls, in two rolls that mirror each other.
// Numbers: an independent prototype's, 0.2 to 0.5 spacings per cycle between centre and walls.

#include "physics/seeds.hpp"

namespace clca::convection_test {
namespace {

constexpr int kSeeds = 8;

// 8 seeds gave 0.295 with a standard error of 0.015, and circulations of 0.0059 and -0.0059 rad per
// cycle with standard deviations of 0.0008 and 0.0014: no sign changes by chance.
TEST(Convection, RisesInsideAndSinksAtTheWallsInTwoRollsThatMirrorEachOther) {
  std::vector<double> rises;
  std::vector<double> sums;
  testing::for_seeds(kSeeds, "convection", {}, [&](const auto& summary, const auto&) {
    const auto value = [&](const char* name) {
      return testing::measure_of(summary, "shaking", name);
    };
    const double left = value("convection_circulation_left");
    const double right = value("convection_circulation_right");
    EXPECT_GT(left, 0);
    EXPECT_LT(right, 0);
    rises.push_back(value("convection_centre_minus_wall"));
    sums.push_back(left + right);
  });
  testing::expect_within("centre_minus_wall", testing::sample(rises).mean, 0.2, 0.5);
  const auto sum = testing::sample(sums);
  testing::expect_within("bias_in_standard_errors", sum.mean / sum.standard_error, -4, 4);
}

}  // namespace
}  // namespace clca::convection_test
