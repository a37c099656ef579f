#include "boltzmann/elementary.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace clca::boltzmann::elementary_test {
namespace {

constexpr int kCases = 1'000'000;
constexpr long double kError = 4e-16L;

double logarithm_error(double x) {
  const long double expected = std::log(static_cast<long double>(x));
  const long double error = std::abs(logarithm(x) - expected);
  return static_cast<double>(error / std::max(1.0L, std::abs(expected)));
}

double circle_error(double turns) {
  const long double angle = 2 * std::numbers::pi_v<long double> * turns;
  const auto [cosine, sine] = cosine_and_sine(turns);
  return static_cast<double>(
      std::max(std::abs(cosine - std::cos(angle)), std::abs(sine - std::sin(angle))));
}

TEST(Elementary, OpenUnitIsNeverZeroAndNeverOne) {
  EXPECT_GT(open_uniform(0), 0);
  EXPECT_LT(open_uniform(~std::uint64_t{0}), 1);
}

TEST(Elementary, LogarithmIsRightToAFewUnitsOfTheLastPlace) {
  std::mt19937_64 bits(1);
  double worst = 0;
  for (int i = 0; i < kCases; ++i) {
    worst = std::max(worst, logarithm_error(open_uniform(bits())));
    worst = std::max(worst, logarithm_error(std::ldexp(1 + open_uniform(bits()), i % 2000 - 1000)));
  }
  EXPECT_LT(worst, kError);
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_LT(logarithm_error(open_uniform(0)), kError);
  EXPECT_LT(logarithm_error(open_uniform(~std::uint64_t{0})), kError);
}

TEST(Elementary, CosineAndSineAreRightToAFewUnitsOfTheLastPlace) {
  std::mt19937_64 bits(2);
  double worst = 0;
  for (int i = 0; i < kCases; ++i) {
    worst = std::max(worst, circle_error(open_uniform(bits())));
    worst = std::max(worst, circle_error(i % 1024 / 1024.0));
  }
  EXPECT_LT(worst, kError);
}

TEST(Elementary, CosineAndSineAreTheSameBitsForManyAtOnce) {
  using Lanes = Eigen::Array<double, 8, 1>;
  std::mt19937_64 bits(3);
  for (int i = 0; i < 1000; ++i) {
    const Lanes turns = Lanes::NullaryExpr([&] { return open_uniform(bits()); });
    const auto [cosines, sines] = cosine_and_sine(turns);
    for (int lane = 0; lane < turns.size(); ++lane) {
      const auto [cosine, sine] = cosine_and_sine(turns[lane]);
      EXPECT_EQ(cosines[lane], cosine);
      EXPECT_EQ(sines[lane], sine);
    }
  }
}

}  // namespace
}  // namespace clca::boltzmann::elementary_test
