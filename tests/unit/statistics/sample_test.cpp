#include "clca/statistics/sample.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace clca::statistics::sample_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Sample, HasMeanAndSpread) {
  const SampleStatistics found = sample_statistics({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_DOUBLE_EQ(found.mean, 5);
  EXPECT_DOUBLE_EQ(found.standard_deviation, std::sqrt(32.0 / 7));
  EXPECT_DOUBLE_EQ(found.standard_error, std::sqrt(32.0 / 7 / 8));
  EXPECT_EQ(found.count, 8U);
  EXPECT_EQ(found.least, 2);
  EXPECT_EQ(found.most, 9);
}

TEST(Sample, OfCountsWithAWholeMeanIsExact) {
  EXPECT_EQ(sample_statistics({143, 165, 154, 121, 187}).mean, 154);
}

TEST(Sample, LeavesOutWhatIsNoNumber) {
  const SampleStatistics found =
      sample_statistics({1, kNan, 3, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(found.count, 2U);
  EXPECT_EQ(found.mean, 2);
}

TEST(Sample, HasNoSpreadThatIsInfinite) {
  const SampleStatistics huge = sample_statistics({6e307, 7e307, 5e307});
  EXPECT_DOUBLE_EQ(huge.mean, 6e307);
  EXPECT_TRUE(std::isnan(huge.standard_deviation));
  EXPECT_TRUE(std::isnan(huge.standard_error));
  EXPECT_TRUE(std::isnan(sample_statistics({-1.7e308, 1.7e308}).mean));
}

TEST(Sample, OfOneOrNoValueHasNoSpread) {
  EXPECT_EQ(sample_statistics({4}).mean, 4);
  EXPECT_TRUE(std::isnan(sample_statistics({4}).standard_deviation));
  EXPECT_TRUE(std::isnan(sample_statistics({4}).standard_error));
  EXPECT_TRUE(std::isnan(sample_statistics({}).mean));
  EXPECT_TRUE(std::isnan(sample_statistics({}).least));
  EXPECT_EQ(sample_statistics({}).count, 0U);
}

TEST(Sample, OfEqualValuesHasASpreadOfExactlyZero) {
  EXPECT_EQ(sample_statistics(std::vector<double>(16, 0.1)).standard_deviation, 0);
  EXPECT_EQ(sample_statistics(std::vector<double>(16, 0.1)).mean, 0.1);
}

TEST(ShareInterval, IsThatOfWilson) {
  // The ends are the shares p with (p - share)^2 = p (1 - p) / n.
  for (const double share : {0.0, 0.1, 0.5, 1.0}) {
    const auto [low, high] = wilson_interval(share, 10);
    for (const double end : {low, high}) {
      EXPECT_NEAR((end - share) * (end - share), end * (1 - end) / 10, 1e-15) << share;
    }
    EXPECT_LE(low, share);
    EXPECT_GE(high, share);
    EXPECT_LT(low, high);
  }
  EXPECT_TRUE(std::isnan(wilson_interval(kNan, 0).first));
}

}  // namespace
}  // namespace clca::statistics::sample_test
