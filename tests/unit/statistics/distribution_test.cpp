#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "clca/statistics/sample.hpp"

namespace clca::statistics::distribution_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(ChiSquare, HasItsKnownQuantiles) {
  // 95 % and 99.9 % quantiles of the usual tables.
  EXPECT_NEAR(chi_square_quantile(0.95, 2), 5.991464547107979, 1e-13);
  EXPECT_NEAR(chi_square_quantile(0.95, 3), 7.814727903251178, 1e-13);
  EXPECT_NEAR(chi_square_quantile(0.999, 3), 16.26623619623813, 1e-11);
  EXPECT_EQ(chi_square_quantile(0, 3), 0);
}

TEST(ChiSquare, QuantileInvertsItsCdf) {
  for (const int degrees : {2, 3}) {
    for (int i = 1; i < 1000; ++i) {
      const double probability = i / 1000.0;
      EXPECT_NEAR(chi_square_cdf(chi_square_quantile(probability, degrees), degrees), probability,
                  4e-16);
    }
  }
}

TEST(ChiSquare, CdfRunsFromZeroToOne) {
  for (const int degrees : {2, 3}) {
    EXPECT_EQ(chi_square_cdf(-1, degrees), 0);
    EXPECT_EQ(chi_square_cdf(0, degrees), 0);
    EXPECT_EQ(chi_square_cdf(kInfinity, degrees), 1);
  }
}

TEST(ChiSquare, RefusesWhatItHasNot) {
  EXPECT_THROW(chi_square_cdf(1, 1), std::invalid_argument);
  EXPECT_THROW(chi_square_cdf(1, 4), std::invalid_argument);
  EXPECT_THROW(chi_square_quantile(0.5, 4), std::invalid_argument);
  EXPECT_THROW(chi_square_quantile(1, 3), std::invalid_argument);
  EXPECT_THROW(chi_square_quantile(-0.1, 3), std::invalid_argument);
  EXPECT_THROW(chi_square_quantile(NAN, 3), std::invalid_argument);
}

TEST(Bins, UniformOnesReachTheEndAndOneGoesBeyond) {
  const Bins bins = Bins::uniform(0.5, 15);
  EXPECT_EQ(bins.count(), 31U);
  EXPECT_EQ(bins.lower(0), 0);
  EXPECT_EQ(bins.upper(29), 15);
  EXPECT_EQ(bins.lower(30), 15);
  EXPECT_EQ(bins.upper(30), kInfinity);
  EXPECT_EQ(Bins::uniform(0.1, 20).count(), 201U);
  EXPECT_EQ(Bins::uniform(1, 2.5).count(), 4U);
  EXPECT_EQ(Bins::uniform(1, 2.5).lower(3), 2.5);
}

TEST(Bins, RefuseSizesThatMakeNoSense) {
  EXPECT_THROW(Bins::uniform(0, 1), std::invalid_argument);
  EXPECT_THROW(Bins::uniform(-1, 1), std::invalid_argument);
  EXPECT_THROW(Bins::uniform(2, 1), std::invalid_argument);
  EXPECT_THROW(Bins::uniform(1e-9, 1), std::invalid_argument);
  EXPECT_THROW(Bins::uniform(1, kInfinity), std::invalid_argument);
  EXPECT_THROW(Bins::uniform(NAN, 1), std::invalid_argument);
  EXPECT_THROW(Bins::equiprobable(1, 3), std::invalid_argument);
  EXPECT_THROW(Bins::equiprobable(1001, 3), std::invalid_argument);
}

TEST(Bins, FindTheOneThatHoldsAValue) {
  for (const Bins& bins :
       {Bins::uniform(0.1, 20), Bins::equiprobable(20, 3), Bins::equiprobable(1000, 2)}) {
    for (std::size_t bin = 0; bin < bins.count(); ++bin) {
      EXPECT_EQ(bins.bin_of(bins.lower(bin)), bin);
      EXPECT_EQ(bins.bin_of(std::nextafter(bins.upper(bin), 0.0)), bin);
    }
    EXPECT_EQ(bins.bin_of(kInfinity), bins.count() - 1);
  }
}

TEST(Shares, OfChiSquareSumToOne) {
  for (const int degrees : {2, 3}) {
    EXPECT_NEAR(sum(chi_square_shares(Bins::uniform(0.1, 20), degrees)), 1, 1e-14);
    EXPECT_THAT(chi_square_shares(Bins::equiprobable(20, degrees), degrees),
                ::testing::Each(::testing::DoubleNear(0.05, 1e-15)));
  }
}

TEST(Shares, CountTheValuesInEachBin) {
  const std::vector<double> values = {0, 0.5, 1, 1.5, 7, 100};
  EXPECT_THAT(bin_shares(values, Bins::uniform(1, 2)),
              ::testing::ElementsAre(2 / 6.0, 2 / 6.0, 2 / 6.0));
  EXPECT_THAT(bin_shares({}, Bins::uniform(1, 2)), ::testing::ElementsAre(0, 0, 0));
}

TEST(HellingerDistance, IsNoneBetweenEqualsAndAllBetweenStrangers) {
  const std::vector<double> third = {1 / 3.0, 1 / 3.0, 1 / 3.0, 0};
  const std::vector<double> other = {0, 0, 0, 1};
  EXPECT_NEAR(hellinger_distance(third, third), 0, 1e-15);
  EXPECT_EQ(hellinger_distance(third, other), 1);
}

TEST(HellingerDistance, IsSymmetricAndFromZeroToOne) {
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> p(20);
    std::vector<double> q(20);
    for (std::vector<double>* one : {&p, &q}) {
      std::generate(one->begin(), one->end(), [&] { return uniform(generator); });
      const double total = sum(*one);
      std::transform(one->begin(), one->end(), one->begin(), [&](double x) { return x / total; });
    }
    const double distance = hellinger_distance(p, q);
    EXPECT_EQ(distance, hellinger_distance(q, p));
    EXPECT_GT(distance, 0);
    EXPECT_LT(distance, 1);
  }
}

TEST(HellingerDistance, OfOneFullBinAmongTwentyIsKnown) {
  const Bins bins = Bins::equiprobable(20, 3);
  const std::vector<double> all_three(1000, 3.0);
  EXPECT_NEAR(hellinger_distance(bin_shares(all_three, bins), chi_square_shares(bins, 3)),
              1 - std::sqrt(1.0 / 20), 1e-14);
}

TEST(HellingerDistance, OfAGaussianSampleIsTheFloorInTheMean) {
  constexpr int kSamples = 300;  // the mean is then good to 2 %
  constexpr std::size_t kValues = 5000;
  const Bins bins = Bins::equiprobable(20, 3);
  const std::vector<double> expected = chi_square_shares(bins, 3);
  std::mt19937_64 generator(2);
  std::normal_distribution<double> normal;
  double distances = 0;
  for (int sample = 0; sample < kSamples; ++sample) {
    std::vector<double> values(kValues);
    for (double& value : values) {
      value = std::pow(normal(generator), 2) + std::pow(normal(generator), 2) +
              std::pow(normal(generator), 2);
    }
    const double scale = sum(values) / (3 * static_cast<double>(kValues));
    std::transform(values.begin(), values.end(), values.begin(),
                   [&](double value) { return value / scale; });
    distances += hellinger_distance(bin_shares(values, bins), expected);
  }
  const double floor = expected_hellinger_distance(bins.count(), kValues);
  EXPECT_DOUBLE_EQ(floor, 18.0 / 40'000);
  EXPECT_NEAR(distances / kSamples, floor, 0.1 * floor);
}

TEST(Distributions, AreComparedBinByBin) {
  const std::vector<double> two = {0.5, 0.5};
  const std::vector<double> one = {1};
  EXPECT_THROW(hellinger_distance(two, one), std::invalid_argument);
  EXPECT_THROW(hellinger_distance(one, two), std::invalid_argument);
  EXPECT_THROW(expected_hellinger_distance(20, 0), std::invalid_argument);
  EXPECT_THROW(expected_hellinger_distance(1, 10), std::invalid_argument);
}

}  // namespace
}  // namespace clca::statistics::distribution_test
