#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clca/measure/force.hpp"

namespace clca::measure::force_distribution_test {
namespace {

using ::testing::ElementsAre;

std::vector<std::size_t> counts_of(const ForceDistribution& distribution) {
  std::vector<std::size_t> counts;
  for (const ForceBin& bin : distribution.bins) {
    counts.push_back(bin.count);
  }
  return counts;
}

double integral(const ForceDistribution& distribution) {
  double sum = 0;
  for (const ForceBin& bin : distribution.bins) {
    sum += bin.density * (bin.high - bin.low) / distribution.mean;
  }
  return sum;
}

TEST(ForceDistribution, OfEqualForcesLiesInOneBinAndNoneAboveTheMean) {
  for (std::size_t count = 1; count < 40; ++count) {
    for (const double strength : {0.1, 0.7, 1.1, 3.3}) {
      const auto found =
          force_distribution(std::vector<double>(count, strength), StrengthKind::averaged).value();
      EXPECT_EQ(found.share_above_mean, 0);
      EXPECT_THAT(counts_of(found), ElementsAre(0, 0, 0, 0, count));
    }
  }
}

TEST(ForceDistribution, OfAveragesHasNoLimitOfSites) {
  EXPECT_DOUBLE_EQ(force_distribution({1e6, 3e6}, StrengthKind::averaged).value().mean, 2e6);
  EXPECT_THROW(force_distribution({1, 1e6}, StrengthKind::whole_sites), std::invalid_argument);
}

TEST(ForceDistribution, OfWholeSitesHasABinForEachNumber) {
  const auto found =
      force_distribution({1, 1, 1, 1, 2, 2, 3, 5}, StrengthKind::whole_sites).value();
  EXPECT_DOUBLE_EQ(found.mean, 2);
  EXPECT_DOUBLE_EQ(found.share_above_mean, 0.25);
  EXPECT_THAT(counts_of(found), ElementsAre(4, 2, 1, 0, 1));
  EXPECT_DOUBLE_EQ(found.bins[0].low, 0.5);
  EXPECT_DOUBLE_EQ(found.bins[4].high, 5.5);
  EXPECT_DOUBLE_EQ(found.bins[0].density, 1);
  EXPECT_DOUBLE_EQ(integral(found), 1);
  EXPECT_EQ(found.tail_contacts, 2U);
  EXPECT_DOUBLE_EQ(found.beta.value(), 2 * std::log(2));  // 0 and 2 over 3: one in the mean
}

TEST(ForceDistribution, OfAveragesHasBinsOfAQuarterOfTheMean) {
  const auto found = force_distribution({0.5, 1, 1.5, 3, 4}, StrengthKind::averaged).value();
  EXPECT_THAT(counts_of(found), ElementsAre(0, 1, 1, 1, 0, 0, 1, 0, 1));
  EXPECT_DOUBLE_EQ(found.bins[1].density, 0.8);
  EXPECT_DOUBLE_EQ(found.bins[8].high, 4.5);
  EXPECT_DOUBLE_EQ(integral(found), 1);
  EXPECT_EQ(found.tail_contacts, 2U);
  EXPECT_DOUBLE_EQ(found.beta.value(), 2 / 1.5);
}

TEST(ForceDistribution, FindsTheSlopeOfAnExponential) {
  constexpr int kCount = 20000;
  for (const double q : {0.5, 0.7, 0.9}) {  // of each site more, that there is one more
    std::vector<double> real;
    std::vector<double> whole;
    for (int quantile = 0; quantile < kCount; ++quantile) {
      const double strength = std::log((quantile + 0.5) / kCount) / std::log(q);
      real.push_back(strength);
      whole.push_back(std::floor(strength) + 1);
    }
    EXPECT_NEAR(force_distribution(real, StrengthKind::averaged)->beta.value(), 1, 0.01);
    const auto found = force_distribution(whole, StrengthKind::whole_sites).value();
    EXPECT_NEAR(found.beta.value(), -std::log(q) / (1 - q), 0.01);
  }
}

TEST(ForceDistribution, HasNoSlopeWithoutATail) {
  EXPECT_FALSE(force_distribution({}, StrengthKind::averaged).has_value());
  const auto alike = force_distribution({2, 2, 2}, StrengthKind::whole_sites).value();
  EXPECT_EQ(alike.tail_contacts, 0U);
  EXPECT_FALSE(alike.beta.has_value());
  const auto two_values = force_distribution({1, 1, 1, 3, 3}, StrengthKind::whole_sites).value();
  EXPECT_EQ(two_values.tail_contacts, 2U);
  EXPECT_TRUE(two_values.beta.has_value());  // 3 is one above the first number of the tail
  EXPECT_FALSE(force_distribution({1, 1, 2, 2}, StrengthKind::whole_sites)->beta.has_value());
}

TEST(ForceAverage, CountsAnAbsentContactAsZero) {
  ForceAverage average;
  EXPECT_TRUE(average.means().empty());
  average.add({{.first = 3, .second = 5, .shared_sites = 4}});
  average.add({{.first = 1, .second = -2, .shared_sites = 2},
               {.first = 3, .second = 5, .shared_sites = 2}});
  average.add({});
  average.add({{.first = 1, .second = 4, .shared_sites = 1}});
  const auto means = average.means();
  EXPECT_EQ(average.sample_count(), 4U);
  EXPECT_THAT(
      means, ElementsAre(ForceAverage::Mean{1, -2, 0.5, 0.25}, ForceAverage::Mean{1, 4, 0.25, 0.25},
                         ForceAverage::Mean{3, 5, 1.5, 0.5}));
  EXPECT_THAT(strengths(means), ElementsAre(0.5, 0.25, 1.5));
}

}  // namespace
}  // namespace clca::measure::force_distribution_test
