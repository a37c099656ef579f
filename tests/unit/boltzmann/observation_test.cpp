#include "clca/boltzmann/observation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace clca::boltzmann::observation_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

Motions gaussian(Eigen::Index particles, double spin_scale) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  Motions motions(6, particles);
  for (double& value : motions.reshaped()) {
    value = normal(generator);
  }
  motions.bottomRows<3>() *= spin_scale;
  return motions;
}

/// |v| = sqrt(3) along x, and |w| = sqrt(3) along axis `axis`, both ways.
Motions parallel(Eigen::Index axis) {
  Motions motions = Motions::Zero(6, 4);
  motions.row(0) << std::sqrt(3.0), -std::sqrt(3.0), std::sqrt(3.0), -std::sqrt(3.0);
  motions.row(3 + axis) << std::sqrt(3.0), std::sqrt(3.0), -std::sqrt(3.0), -std::sqrt(3.0);
  return motions;
}

TEST(Moments, OfTwoParticlesAreThoseCountedByHand) {
  Motions motions(6, 2);
  motions.col(0) << 1, 2, 2, 0, 3, 4;    // v^2 = 9, w^2 = 25, v w = 14
  motions.col(1) << -1, 0, 0, 1, 0, -2;  // v^2 = 1, w^2 = 5, v w = -1
  const Moments result = moments(motions);
  EXPECT_DOUBLE_EQ(result.translational, 5 / 3.0);
  EXPECT_DOUBLE_EQ(result.rotational, 5);
  EXPECT_DOUBLE_EQ(result.a2_translational, 3 * 41 / (5 * 25.0) - 1);
  EXPECT_DOUBLE_EQ(result.a2_rotational, 3 * 325 / (5 * 225.0) - 1);
  EXPECT_DOUBLE_EQ(result.correlation, 115 / (5 * 15.0) - 1);
  EXPECT_DOUBLE_EQ(result.alignment, (3 * 98.5 - 115) / (5 * 15.0));
  EXPECT_DOUBLE_EQ(result.p_xx, 3 * 1 / 5.0);
  EXPECT_DOUBLE_EQ(result.p_yy, 3 * 2 / 5.0);
  EXPECT_DOUBLE_EQ(result.p_xy, 3 * 1 / 5.0);
}

TEST(Moments, OfANormalGasAreThoseOfNoCorrelation) {
  const Moments result = moments(gaussian(1'000'000, 2));
  // Standard errors are 1e-3 to 3e-3.
  EXPECT_NEAR(result.translational, 1, 5e-3);
  EXPECT_NEAR(result.rotational, 4, 2e-2);
  EXPECT_NEAR(result.a2_translational, 0, 7e-3);
  EXPECT_NEAR(result.a2_rotational, 0, 7e-3);
  EXPECT_NEAR(result.correlation, 0, 5e-3);
  EXPECT_NEAR(result.alignment, 0, 1e-2);
  EXPECT_NEAR(result.p_xx, 1, 7e-3);
  EXPECT_NEAR(result.p_yy, 1, 7e-3);
  EXPECT_NEAR(result.p_xy, 0, 5e-3);
}

TEST(Moments, OfAMillionParticlesAreRightToTheLastDigits) {
  const Motions motions = gaussian(1'000'000, 2);
  long double energy = 0;
  long double squares = 0;
  for (Eigen::Index i = 0; i < motions.cols(); ++i) {
    const long double square = motions.col(i).head<3>().square().sum();
    energy += square;
    squares += square * square;
  }
  const Moments result = moments(motions);
  const auto count = static_cast<long double>(motions.cols());
  EXPECT_NEAR(result.translational, static_cast<double>(energy / count / 3), 1e-14);
  EXPECT_NEAR(result.a2_translational,
              static_cast<double>(3 * squares * count / (5 * energy * energy) - 1), 1e-13);
}

TEST(Moments, TellSpinsAlongTheVelocityFromThoseAcross) {
  EXPECT_DOUBLE_EQ(moments(parallel(0)).alignment, 2);
  EXPECT_DOUBLE_EQ(moments(parallel(1)).alignment, -1);
  EXPECT_DOUBLE_EQ(moments(parallel(1)).a2_translational, 3 / 5.0 - 1);
  EXPECT_DOUBLE_EQ(moments(parallel(1)).p_xx, 3);
}

TEST(Moments, OfNoSpinAreZero) {
  const Moments result = moments(gaussian(100, 0));
  EXPECT_GT(result.translational, 0);
  EXPECT_EQ(result.rotational, 0);
  EXPECT_EQ(result.a2_rotational, 0);
  EXPECT_EQ(result.correlation, 0);
  EXPECT_EQ(result.alignment, 0);
}

TEST(EnergyShares, AreOfTheEnergyInUnitsOfItsPresentScale) {
  const Motions motions = parallel(1) * 7;  // all X = 3
  const EnergyShares result =
      energy_shares(motions, moments(motions), statistics::Bins::uniform(2, 4));
  EXPECT_THAT(result.translational, ElementsAre(0, 1, 0));
  EXPECT_THAT(result.rotational, ElementsAre(0, 1, 0));
}

TEST(EnergyShares, OfANormalGasAreThoseOfChiSquare) {
  const Motions motions = gaussian(100'000, 2);
  const statistics::Bins bins = statistics::Bins::equiprobable(20, 3);
  const EnergyShares result = energy_shares(motions, moments(motions), bins);
  // Standard error 7e-4.
  EXPECT_THAT(result.translational, Each(::testing::DoubleNear(0.05, 3.5e-3)));
  EXPECT_THAT(result.rotational, Each(::testing::DoubleNear(0.05, 3.5e-3)));
}

TEST(EnergyShares, OfNoSpinAreZero) {
  const Motions motions = gaussian(100, 0);
  const EnergyShares result =
      energy_shares(motions, moments(motions), statistics::Bins::uniform(1, 2));
  EXPECT_THAT(result.rotational, ElementsAre(0, 0, 0));
}

}  // namespace
}  // namespace clca::boltzmann::observation_test
