// Forces as means over several steps.

#include "clca/contact/force.hpp"

#include <gtest/gtest.h>

namespace clca::contact::force_test {
namespace {

Force between(std::uint32_t upper, grains::Owner other, const Eigen::Vector2d& normal,
              double normal_force, double shear_force) {
  Force force;
  force.upper = upper;
  force.other = other;
  force.normal = normal;
  force.branch = 3 * normal;
  force.normal_force = normal_force;
  force.shear_force = shear_force;
  return force;
}

const Eigen::Vector2d kUp(0, 1);

TEST(ForceSums, AContactCountsAsZeroInStepsWithoutIt) {
  ForceSums sums;
  add(sums, std::vector{between(1, 0, kUp, 4, 2), between(0, kFloor, kUp, 1, 0)}, 1);
  add(sums, std::vector{between(0, kFloor, kUp, 3, 0)}, 1);
  const std::vector<Force> result = mean_forces(sums);
  ASSERT_EQ(result.size(), 2U);
  EXPECT_EQ(result[0].other, kFloor);
  EXPECT_DOUBLE_EQ(result[0].normal_force, 2);
  EXPECT_DOUBLE_EQ(result[0].share, 1);
  EXPECT_EQ(result[1].upper, 1U);
  EXPECT_DOUBLE_EQ(result[1].share, 0.5);
  EXPECT_DOUBLE_EQ(result[1].normal_force, 2);
  EXPECT_DOUBLE_EQ(result[1].shear_force, 1);
  EXPECT_EQ(result[1].branch, 3 * kUp);
}

TEST(ForceSums, TwoGrainsThatChangePlacesKeepTheirForce) {
  ForceSums sums;
  const Eigen::Vector2d right(1, 0);
  add(sums, std::vector{between(1, 0, right, 4, 1)}, 1);
  add(sums, std::vector{between(0, 1, -right, 2, 3)}, 1);
  const std::vector<Force> result = mean_forces(sums);
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(result[0].upper, 0U);
  EXPECT_DOUBLE_EQ(result[0].normal_force, 3);
  EXPECT_DOUBLE_EQ(result[0].shear_force, 2);
}

TEST(ForceSums, TheMeanIsThatOfVectorsWhereTheNormalTurns) {
  ForceSums sums;
  add(sums, std::vector{between(1, 0, {1, 0}, 2, 0)}, 1);
  add(sums, std::vector{between(1, 0, kUp, 6, 0)}, 1);
  const Force mean = mean_forces(sums).at(0);
  EXPECT_EQ(mean.normal, kUp);
  EXPECT_NEAR((mean.on_upper() - Eigen::Vector2d(1, 3)).norm(), 0, 1e-12);
}

TEST(ForceSums, SumsOfTwoSpansAreThoseOfTheWhole) {
  ForceSums first;
  ForceSums second;
  ForceSums whole;
  for (int step = 0; step < 4; ++step) {
    const std::vector forces = {between(1, 0, kUp, step, -step)};
    add(step < 2 ? first : second, forces, 1);
    add(whole, forces, 1);
  }
  add(first, second);
  EXPECT_EQ(first.steps, 4U);
  EXPECT_EQ(first.sums, whole.sums);
}

TEST(ForceSums, MeansAreInWeightsOfTheLastMeanMass) {
  ForceSums sums;
  add(sums, std::vector{between(0, kFloor, kUp, 2, 0)}, 7);
  add(sums, std::vector{between(0, kFloor, kUp, 1, 0)}, 14);  // as heavy, among heavier grains
  EXPECT_DOUBLE_EQ(mean_forces(sums).at(0).normal_force, 1);
  set_mean_mass(sums, 7);
  EXPECT_DOUBLE_EQ(mean_forces(sums).at(0).normal_force, 2);
}

TEST(ForceSums, NoStepsHaveNoForces) {
  EXPECT_TRUE(mean_forces({}).empty());
}

}  // namespace
}  // namespace clca::contact::force_test
