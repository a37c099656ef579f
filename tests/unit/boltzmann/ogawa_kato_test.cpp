#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann::ogawa_kato_test {
namespace {

constexpr Law kPaper = {.restitution = 0.5, .friction = 0.3};

Gas gas_of(std::uint64_t particles, std::uint64_t seed = 1) {
  return make_gas({.particle_count = particles}, seed);
}

Gas advanced(Gas gas, const Law& law, const OgawaKato& scheme, double time, int threads = 1) {
  advance(gas, {.law = law, .scheme = scheme}, 1, time, threads);
  return gas;
}

double temperature(const Gas& gas) {
  return gas.motions.topRows<3>().square().mean();
}

TEST(OgawaKato, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const bool quasi : {false, true}) {
    const OgawaKato scheme = {.quasi_random = quasi};
    const std::uint64_t expected = hash(advanced(gas_of(1001), kPaper, scheme, 1.01));
    for (const int threads : {2, 3, 7}) {
      EXPECT_EQ(hash(advanced(gas_of(1001), kPaper, scheme, 1.01, threads)), expected);
    }
  }
}

TEST(OgawaKato, GivesOtherBitsForOtherSeeds) {
  for (const bool quasi : {false, true}) {
    Gas one = gas_of(1000);
    Gas other = one;
    advance(one, {.law = kPaper, .scheme = OgawaKato{.quasi_random = quasi}}, 1, 1, 1);
    advance(other, {.law = kPaper, .scheme = OgawaKato{.quasi_random = quasi}}, 2, 1, 1);
    EXPECT_NE(hash(one), hash(other));
  }
}

TEST(OgawaKato, LandsOnTheTimeAskedFor) {
  const Gas whole = advanced(gas_of(10), kPaper, {}, 15);
  EXPECT_EQ(whole.time, 15);
  EXPECT_EQ(whole.step, 600U);
  const Gas broken = advanced(gas_of(10), kPaper, {}, 0.26);
  EXPECT_EQ(broken.time, 0.26);
  EXPECT_EQ(broken.step, 11U);
  EXPECT_EQ(hash(advanced(broken, kPaper, {}, 0.26)), hash(broken));
}

TEST(OgawaKato, GoesOnAfterAStopAsIfThereHadBeenNone) {
  const Gas unbroken = advanced(gas_of(500), kPaper, {}, 2);
  Gas stopped = gas_of(500);
  advance(stopped, {.law = kPaper, .scheme = OgawaKato{}}, 1, 2, 1,
          [](const Gas& gas) { return gas.step < 37; });
  EXPECT_EQ(stopped.step, 37U);
  EXPECT_NEAR(stopped.time, 37 * 0.025, 1e-12);
  EXPECT_EQ(hash(advanced(stopped, kPaper, {}, 2)), hash(unbroken));
}

TEST(OgawaKato, CountsEveryParticleThatChanges) {
  const Gas before = gas_of(5000);
  const Gas after = advanced(before, kPaper, {}, 0.025);
  const auto changed = (before.motions != after.motions).colwise().any().count();
  EXPECT_EQ(after.participations, static_cast<std::uint64_t>(changed));
}

TEST(OgawaKato, CollidesAtTheRateOfAMaxwellianGas) {
  // 1 - <exp(-x)> with x of mean (4 / sqrt pi) dt = 0.022568: less by x^2 / 2, 1 to 1.5 %.
  constexpr double kStep = 0.01;
  const Gas gas = advanced(gas_of(200'000), kPaper, {.time_step = kStep}, kStep);
  const double rate = 4 * std::numbers::inv_sqrtpi;
  EXPECT_NEAR(gas.collisions_per_particle(), rate * kStep * 0.987, 4.5 * std::sqrt(0.0226 / 2e5));
}

TEST(OgawaKato, NeverLetsAParticleMeetItself) {
  // The only partner is the other one. Alone with itself, g would be 0 and nothing would happen;
  // half of the draws would be lost.
  const Law elastic = {.restitution = 1};
  std::uint64_t participations = 0;
  constexpr int kRuns = 2000;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    Gas gas;
    gas.motions = Motions::Zero(6, 2);
    gas.motions(0, 0) = 1;
    gas.motions(0, 1) = -1;
    advance(gas, {.law = elastic, .scheme = OgawaKato{.time_step = 0.5}}, seed, 0.5, 1);
    participations += gas.participations;
  }
  const double expected = 1 - std::exp(-1.0);
  EXPECT_NEAR(static_cast<double>(participations) / (2.0 * kRuns), expected,
              4.5 * std::sqrt(expected * (1 - expected) / (2.0 * kRuns)));
}

TEST(OgawaKato, DoesNotConserveMomentumAsOnlyOneOfEachPairChanges) {
  const Gas gas = advanced(gas_of(1000), {.restitution = 1}, {}, 1);
  const double drift = gas.motions.topRows<3>().rowwise().mean().matrix().norm();
  EXPECT_GT(drift, 1e-3);
  EXPECT_LT(drift, 0.2);  // about 2 / sqrt(particles)
}

TEST(OgawaKato, LeavesTheSpinsOfSmoothSpheresAlone) {
  const Gas before = gas_of(100);
  const Gas after = advanced(before, {.restitution = 0.5}, {}, 5);
  EXPECT_TRUE((before.motions.bottomRows<3>() == after.motions.bottomRows<3>()).all());
}

TEST(OgawaKato, CoolsByTheSameLawOnALattice) {
  // Both within 4 standard deviations of a run, 1.3 % at 10 000 particles, of each other.
  for (const int partners : {10, 25}) {
    const OgawaKato independent = {.partner_count = partners};
    const OgawaKato lattice = {.partner_count = partners, .quasi_random = true};
    const double expected = temperature(advanced(gas_of(10'000), kPaper, independent, 2));
    const double found = temperature(advanced(gas_of(10'000), kPaper, lattice, 2));
    EXPECT_NEAR(found / expected, 1, 4 * std::numbers::sqrt2 * 0.013) << partners;
  }
}

TEST(OgawaKato, HeatsWhatShouldKeepItsEnergyAsMuchAsExpected) {
  // A run of 50 000 particles scatters by 0.010 at time 5; the expectation holds to 0.003.
  const Law elastic = {.restitution = 1};
  for (const int partners : {1, 10}) {
    const OgawaKato scheme = {.time_step = 0.1, .partner_count = partners};
    const double heating = temperature(advanced(gas_of(50'000), elastic, scheme, 5)) - 1;
    EXPECT_NEAR(heating, expected_heating(scheme, 5), 4 * 0.010 + 0.003) << partners;
  }
}

TEST(OgawaKato, IsExpectedToHeatByNineToTenPercentAsPrinted) {
  EXPECT_NEAR(expected_heating({}, 15), 0.098, 0.001);
  EXPECT_EQ(expected_heating({.partner_count = 1}, 15), 0);
  EXPECT_TRUE(std::isinf(expected_heating({.time_step = 0.1}, 50)));
}

TEST(OgawaKato, RefusesStepsWithoutDurationAndParticlesWithoutPartners) {
  Gas gas = gas_of(10);
  EXPECT_THROW(advance(gas, {.law = kPaper, .scheme = OgawaKato{.time_step = 0}}, 1, 1, 1),
               std::invalid_argument);
  EXPECT_THROW(advance(gas, {.law = kPaper, .scheme = OgawaKato{.partner_count = 0}}, 1, 1, 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace clca::boltzmann::ogawa_kato_test
