#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "clca/boltzmann/gas.hpp"

namespace clca::boltzmann::initial_condition_test {
namespace {

constexpr double kRounding = 1e-13;

InitialCondition initial_condition(std::uint64_t particles, InitialDistribution initial,
                                   bool exact_moments, bool quasi) {
  return {.particle_count = particles,
          .distribution = initial,
          .energy_ratio = 0.7,
          .exact_moments = exact_moments,
          .quasi_random = quasi};
}

// 1/3 of the mean squares of velocity and spin.
std::pair<double, double> mean_squares(const Gas& gas) {
  const auto count = static_cast<double>(gas.particle_count());
  return {gas.motions.topRows<3>().square().sum() / (3 * count),
          gas.motions.bottomRows<3>().square().sum() / (3 * count)};
}

TEST(InitialCondition, HasExactMomentsWhereAskedForThem) {
  for (const InitialDistribution initial :
       {InitialDistribution::gaussian, InitialDistribution::equal_energy}) {
    for (const bool quasi : {false, true}) {
      for (const std::uint64_t particles : {3U, 4U, 1000U, 1001U, 4096U}) {
        const Gas gas = make_gas(initial_condition(particles, initial, true, quasi), 5);
        ASSERT_EQ(gas.particle_count(), static_cast<Eigen::Index>(particles));
        EXPECT_LT(gas.motions.rowwise().mean().abs().maxCoeff(), kRounding);
        const auto [velocity, spin] = mean_squares(gas);
        EXPECT_NEAR(velocity, 1, kRounding);
        EXPECT_NEAR(spin, 2.5 * 0.7, kRounding);
      }
    }
  }
}

TEST(InitialCondition, GivesAllTheSameEnergyInCase2) {
  for (const bool exact_moments : {false, true}) {
    for (const std::uint64_t particles : {2U, 3U, 501U}) {
      const Gas gas = make_gas(
          initial_condition(particles, InitialDistribution::equal_energy, exact_moments, false), 5);
      for (const auto& motion : gas.motions.colwise()) {
        EXPECT_NEAR(motion.head<3>().matrix().norm(), std::sqrt(3.0), kRounding);
        EXPECT_NEAR(motion.tail<3>().matrix().norm(), std::sqrt(3 * 2.5 * 0.7), kRounding);
      }
    }
  }
}

// Mean of the products of all pairs of components, in units of the standard deviation that it has
// for independent particles.
void expect_independent_components(const Gas& gas, double sigmas) {
  const auto count = static_cast<double>(gas.particle_count());
  Eigen::Matrix<double, 6, 6> covariance =
      gas.motions.matrix() * gas.motions.matrix().transpose() / count;
  for (Eigen::Index a = 0; a < 6; ++a) {
    for (Eigen::Index b = 0; b < a; ++b) {
      const double expected = std::sqrt(covariance(a, a) * covariance(b, b) / count);
      EXPECT_LT(std::abs(covariance(a, b)), sigmas * expected) << a << ", " << b;
    }
  }
}

TEST(InitialCondition, HasIndependentComponents) {
  for (const InitialDistribution initial :
       {InitialDistribution::gaussian, InitialDistribution::equal_energy}) {
    for (const bool exact_moments : {false, true}) {
      expect_independent_components(
          make_gas(initial_condition(20'000, initial, exact_moments, false), 8), 4.5);
    }
  }
}

TEST(InitialCondition, IsMoreEvenOnALatticeThanByChance) {
  for (const InitialDistribution initial :
       {InitialDistribution::gaussian, InitialDistribution::equal_energy}) {
    expect_independent_components(make_gas(initial_condition(16'384, initial, false, true), 8),
                                  0.5);
  }
}

TEST(InitialCondition, HasNormalVelocitiesAndSpinsInCase1) {
  const Gas gas =
      make_gas(initial_condition(100'000, InitialDistribution::gaussian, false, false), 3);
  const auto count = static_cast<double>(gas.motions.size());
  Motions scaled = gas.motions;
  scaled.bottomRows<3>() /= std::sqrt(2.5 * 0.7);
  // Moments 2, 4 and 6 of a normal variable: 1, 3, 15, with variances 2, 96, 10170.
  EXPECT_NEAR(scaled.square().mean(), 1, 4.5 * std::sqrt(2 / count));
  EXPECT_NEAR(scaled.pow(4).mean(), 3, 4.5 * std::sqrt(96 / count));
  EXPECT_NEAR(scaled.pow(6).mean(), 15, 4.5 * std::sqrt(10'170 / count));
}

TEST(InitialCondition, MayHaveNoSpin) {
  const Gas gas = make_gas({.particle_count = 10, .energy_ratio = 0}, 3);
  EXPECT_EQ(gas.motions.bottomRows<3>().abs().maxCoeff(), 0);
}

TEST(InitialCondition, DependsOnTheSeedAndOnNothingElse) {
  for (const bool quasi : {false, true}) {
    const auto from = [&](std::uint64_t seed) {
      return hash(
          make_gas(initial_condition(100, InitialDistribution::gaussian, true, quasi), seed));
    };
    EXPECT_EQ(from(1), from(1));
    EXPECT_NE(from(1), from(2));
    EXPECT_NE(from(1), from(1 + (1ULL << 32U)));
  }
}

TEST(InitialCondition, RefusesFewerThanTwoParticles) {
  EXPECT_THROW(make_gas({.particle_count = 1}, 1), std::invalid_argument);
  EXPECT_THROW(make_gas({.particle_count = 0}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace clca::boltzmann::initial_condition_test
