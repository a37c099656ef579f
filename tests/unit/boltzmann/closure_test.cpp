#include "clca/boltzmann/closure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "general_law.hpp"
#include "random_contacts.hpp"
#include "support/gas_closed_forms.hpp"

namespace clca::boltzmann::closure_test {
namespace {

using testing::cooling_a2;
using testing::critical_restitution;
using testing::haff_temperature;
using testing::rough_ratio;

constexpr double kNone = kNoSlidingLimit;

struct Slope {
  double mean = 0;
  double error = 0;  ///< standard error
};

Slope slope(const std::vector<double>& samples) {
  const auto count = static_cast<double>(samples.size());
  double sum = 0;
  double squares = 0;
  for (const double sample : samples) {
    sum += sample;
    squares += sample * sample;
  }
  const double mean = sum / count;
  return {.mean = mean, .error = std::sqrt((squares / count - mean * mean) / count)};
}

struct Slopes {
  Slope translational;
  Slope rotational;
};

/// Rates of both temperatures from collisions of pairs drawn from a normal gas.
Slopes sampled_rates(const Law& law, const Temperatures& temperatures) {
  constexpr int kPairs = 50'000;
  RandomContacts random(1);
  std::vector<double> translational;
  std::vector<double> rotational;
  for (int i = 0; i < kPairs; ++i) {
    CollisionState before;
    for (Motion* motion : {&before.first, &before.second}) {
      motion->velocity = std::sqrt(temperatures.translational) * random.vector();
      motion->spin = std::sqrt(temperatures.rotational) * random.vector();
    }
    const Eigen::Vector3d approach = before.first.velocity - before.second.velocity;
    before.normal = (approach.normalized() + random.vector().normalized()).normalized();
    const CollisionState after = collide(law, Pair{}, before);
    // Every particle takes part in a collision at the rate |g|, each collision has two of them.
    const double weight = approach.norm() / 2 / 3;
    translational.push_back(
        weight * (after.first.velocity.squaredNorm() + after.second.velocity.squaredNorm() -
                  before.first.velocity.squaredNorm() - before.second.velocity.squaredNorm()));
    rotational.push_back(weight *
                         (after.first.spin.squaredNorm() + after.second.spin.squaredNorm() -
                          before.first.spin.squaredNorm() - before.second.spin.squaredNorm()));
  }
  return {.translational = slope(translational), .rotational = slope(rotational)};
}

TEST(MaxwellianRate, IsThatOfTheKineticTheoryOfGases) {
  EXPECT_NEAR(maxwellian_collision_rate(1), 2.256758, 5e-7);
  EXPECT_DOUBLE_EQ(maxwellian_collision_rate(4), 2 * maxwellian_collision_rate(1));
}

TEST(ClosureRates, AreTheKnownFirstSlopes) {
  const Temperatures begin = {.translational = 1, .rotational = 2.5};
  const Temperatures inelastic = temperature_rates({.restitution = 0.5, .friction = 0.3}, begin);
  EXPECT_NEAR(inelastic.translational, -0.721798, 5e-7);
  EXPECT_NEAR(inelastic.rotational / 2.5, -0.394022, 5e-7);
  const Temperatures elastic = temperature_rates({.restitution = 1, .friction = 0.3}, begin);
  EXPECT_NEAR(elastic.translational, -0.175575, 5e-7);
  EXPECT_NEAR(elastic.rotational / 2.5, -0.438937, 5e-7);
}

TEST(ClosureRates, AreThoseOfSampledCollisions) {
  const std::vector<Law> laws = {
      {.restitution = 0.5, .friction = 0.3},
      {.restitution = 1, .friction = 0.1},
      {.restitution = 0.2, .friction = 1},
      {.restitution = 0.9, .friction = 0.4, .roughness = 0.5},
      {.restitution = 0.7, .friction = 0.2, .roughness = -0.6},
      {.restitution = 0.9, .friction = kNone, .roughness = 0.5},
      {.restitution = 0.9, .friction = kNone, .roughness = -0.5},
      {.restitution = 1, .friction = kNone, .roughness = 1},
      {.restitution = 0.6},
  };
  for (const Law& law : laws) {
    for (const double energy_ratio : {0.0, 0.2, 1.0, 5.0}) {
      const Temperatures present = {.translational = 1.3, .rotational = 2.5 * energy_ratio};
      const Temperatures rates = temperature_rates(law, present);
      const Slopes sampled = sampled_rates(law, present);
      SCOPED_TRACE(::testing::Message() << law.restitution << ' ' << law.friction << ' '
                                        << law.roughness << ' ' << energy_ratio);
      constexpr double kRounding = 1e-12;
      EXPECT_NEAR(rates.translational, sampled.translational.mean,
                  5 * sampled.translational.error + kRounding);
      EXPECT_NEAR(rates.rotational, sampled.rotational.mean,
                  5 * sampled.rotational.error + kRounding);
    }
  }
}

TEST(ClosureRates, AreNoneWithoutMotion) {
  const Temperatures rates = temperature_rates({.restitution = 0.5, .friction = 0.3},
                                               {.translational = 0, .rotational = 1});
  EXPECT_EQ(rates.translational, 0);
  EXPECT_EQ(rates.rotational, 0);
}

TEST(ClosureRates, LeaveTheSteadyRatioOfRoughSpheresAlone) {
  for (const double restitution : {0.5, 0.8, 1.0}) {
    for (const double roughness : {-0.9, -0.3, 0.0, 0.6, 0.95}) {
      const double ratio = rough_ratio(restitution, roughness);
      const Temperatures rates =
          temperature_rates({.restitution = restitution, .friction = kNone, .roughness = roughness},
                            {.translational = 1, .rotational = 2.5 * ratio});
      EXPECT_NEAR(rates.rotational / (2.5 * ratio), rates.translational, 1e-12);
    }
  }
}

TEST(ClosureRates, LetTheSpinsOutliveTheVelocitiesBelowTheCriticalRestitution) {
  const double critical = critical_restitution(0.3);
  EXPECT_NEAR(critical, 0.8349, 5e-5);
  const Temperatures spinning = {.translational = 1, .rotational = 1e10};
  const auto heating = [&](double restitution) {
    return temperature_rates({.restitution = restitution, .friction = 0.3}, spinning).translational;
  };
  EXPECT_LT(heating(critical - 0.01), 0);
  EXPECT_GT(heating(critical + 0.01), 0);
}

TEST(Closure, OfSmoothSpheresIsHaffsLaw) {
  for (const double restitution : {0.2, 0.8, 1.0}) {
    const Temperatures end = temperatures_after({.restitution = restitution}, {}, 40);
    EXPECT_NEAR(end.translational, haff_temperature(restitution, 40), 1e-8);
    EXPECT_EQ(end.rotational, 1);
  }
}

TEST(Closure, IsTheSameInOnePieceAndInTwo) {
  const Law law = {.restitution = 0.5, .friction = 0.3};
  const Temperatures begin = {.translational = 1, .rotational = 2.5};
  const Temperatures whole = temperatures_after(law, begin, 10);
  const Temperatures pieces = temperatures_after(law, temperatures_after(law, begin, 3.3), 6.7);
  EXPECT_NEAR(whole.translational, pieces.translational, 1e-9);
  EXPECT_NEAR(whole.rotational, pieces.rotational, 1e-9);
}

TEST(Closure, RoughSpheresReachTheirSteadyRatio) {
  const Law law = {.restitution = 0.9, .friction = kNone, .roughness = 0.3};
  const Temperatures end = temperatures_after(law, {.translational = 1, .rotational = 0.1}, 1e5);
  EXPECT_NEAR(end.rotational / end.translational / 2.5, rough_ratio(0.9, 0.3), 1e-9);
}

TEST(RoughRatio, IsEquipartitionWhereNothingIsLost) {
  EXPECT_DOUBLE_EQ(rough_ratio(1, 1), 1);
}

TEST(HaffTemperature, FallsAtTheMeasuredRates) {
  // Rates and second cumulants that an independent program found in cooling smooth spheres.
  struct Measured {
    double restitution;
    double rate;
    double a2;
  };
  for (const Measured& measured :
       {Measured{0.2, 0.36927, 0.1282}, Measured{0.5, 0.28473, 0.0477},
        Measured{0.8, 0.13492, -0.0146}, Measured{0.9, 0.07129, -0.0154}}) {
    const double temperature = haff_temperature(measured.restitution, 10, measured.a2);
    EXPECT_NEAR(1 / std::sqrt(temperature), 1 + 10 * measured.rate, 10 * 2e-3 * measured.rate);
  }
}

TEST(CoolingA2, IsCloseToTheMeasuredOneForNearlyElasticSpheres) {
  EXPECT_EQ(cooling_a2(1), 0);
  EXPECT_NEAR(cooling_a2(std::numbers::sqrt2 / 2), 0, 1e-15);
  EXPECT_NEAR(cooling_a2(0.9), -0.0154, 1e-3);  // found as the rates above
  EXPECT_NEAR(cooling_a2(0.8), -0.0146, 2.5e-3);
}

TEST(ShearFlow, IsSteady) {
  const double shear_rate = 0.37;
  for (const double restitution : {0.0, 0.5, 0.9, 0.999}) {
    const ShearFlow flow = steady_shear_flow(restitution, shear_rate);
    const double root = std::sqrt(flow.temperature * std::numbers::inv_pi);
    const double nu = 16.0 / 5 * root;
    const double cooling = 4.0 / 3 * (1 - restitution * restitution) * root;
    const double relaxation = (1 + restitution) * (2 + restitution) / 6 * nu;
    // d P_ij / dt of all elements, relative to the mean pressure.
    EXPECT_NEAR(-2 * shear_rate * flow.p_xy - relaxation * (flow.p_xx - 1) - cooling * flow.p_xx, 0,
                1e-13);
    EXPECT_NEAR(-relaxation * (flow.p_yy - 1) - cooling * flow.p_yy, 0, 1e-13);
    EXPECT_NEAR(-shear_rate * flow.p_yy - (relaxation + cooling) * flow.p_xy, 0, 1e-13);
    EXPECT_NEAR(flow.p_xx + 2 * flow.p_yy, 3, 1e-13);
    // The energy that shearing brings is that which Haff's law takes.
    constexpr double kStep = 1e-6;
    EXPECT_NEAR(-2 * shear_rate * flow.p_xy / 3 * flow.temperature,
                -(haff_temperature(restitution, kStep * std::sqrt(flow.temperature)) - 1) / kStep *
                    flow.temperature,
                1e-4 * flow.temperature);
  }
}

TEST(ShearFlow, RefusesWhatIsNeverSteady) {
  EXPECT_THROW(steady_shear_flow(1, 1), std::invalid_argument);
  EXPECT_THROW(steady_shear_flow(-0.1, 1), std::invalid_argument);
  EXPECT_THROW(steady_shear_flow(0.5, 0), std::invalid_argument);
  EXPECT_THROW(steady_shear_flow(NAN, 1), std::invalid_argument);
}

TEST(Closure, IsSoonDoneWithLongTimesWhereNothingIsLost) {
  const Law lossless = {.restitution = 1, .friction = kNoSlidingLimit, .roughness = 1};
  const Temperatures end =
      temperatures_after(lossless, {.translational = 1, .rotational = 0.5}, 1e9);
  EXPECT_NEAR(end.translational, end.rotational / 2.5, 1e-9);
}

}  // namespace
}  // namespace clca::boltzmann::closure_test
