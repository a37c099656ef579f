#include "boltzmann/lattice_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clca::boltzmann::lattice_rule_test {
namespace {

std::vector<double> coordinates(const LatticeRule& rule, int dimension) {
  std::vector<double> result;
  for (std::uint64_t point = 0; point < rule.point_count(); ++point) {
    result.push_back(rule.coordinate(point, dimension));
  }
  return result;
}

TEST(LatticeRule, HasEvenlySpacedProjectionsForPowersOfTwo) {
  LatticeRule rule(1024);
  rule.shift(7, {});
  for (int dimension = 0; dimension < LatticeRule::kDimensions; ++dimension) {
    std::vector<double> values = coordinates(rule, dimension);
    std::sort(values.begin(), values.end());
    for (std::size_t i = 1; i < values.size(); ++i) {
      EXPECT_NEAR(values[i] - values[i - 1], 1.0 / 1024, 1e-15);
    }
  }
}

TEST(LatticeRule, IsTheOneThatTheGeneratingVectorSays) {
  const LatticeRule rule(1024);
  // 5 * 182667 = 913335 = 891 * 1024 + 951.
  EXPECT_NEAR(rule.coordinate(5, 0), 5.0 / 1024, 1e-15);
  EXPECT_NEAR(rule.coordinate(5, 1), 951.0 / 1024, 1e-15);
}

TEST(LatticeRule, GivesTheBeginningOfTheEmbeddedSequenceForOtherNumbers) {
  // By radical inverse: 0, 1/2, 1/4, 3/4, 1/8, 5/8.
  const std::vector<double> values = coordinates(LatticeRule(6), 0);
  const std::vector<double> expected = {0, 0.125, 0.25, 0.5, 0.625, 0.75};
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(values[i], expected[i], 1e-15);
  }
}

TEST(LatticeRule, AscendsInItsFirstDimensionUnshifted) {
  for (const std::uint64_t points : {1U, 2U, 3U, 1000U, 10'000U}) {
    const LatticeRule rule(points);
    EXPECT_EQ(rule.point_count(), points);
    const std::vector<double> values = coordinates(rule, 0);
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
  }
}

TEST(LatticeRule, StaysInsideTheUnitCube) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    LatticeRule rule(100);
    rule.shift(seed, {});
    for (int dimension = 0; dimension < LatticeRule::kDimensions; ++dimension) {
      for (const double value : coordinates(rule, dimension)) {
        EXPECT_GT(value, 0);
        EXPECT_LT(value, 1);
      }
    }
  }
}

TEST(LatticeRule, MovesByAnotherVectorForEachSeedStepAndGroup) {
  const auto first = [](std::uint64_t seed, const random::DrawCounter& place) {
    LatticeRule rule(16);
    rule.shift(seed, place);
    return rule.coordinate(0, 0);
  };
  EXPECT_EQ(first(1, {}), first(1, {}));
  EXPECT_NE(first(1, {}), first(2, {}));
  EXPECT_NE(first(1, {}), first(1, {.step = 1}));
  EXPECT_NE(first(1, {}), first(1, {.group = 1}));
}

// A product of all pairs of dimensions, mean 1: what the weights of order 2 are made for.
double pairwise(const LatticeRule& rule) {
  double sum = 0;
  for (std::uint64_t point = 0; point < rule.point_count(); ++point) {
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < a; ++b) {
        sum += 4 * rule.coordinate(point, a) * rule.coordinate(point, b) / 15;
      }
    }
  }
  return sum / static_cast<double>(rule.point_count());
}

TEST(LatticeRule, IntegratesPairsOfDimensionsFarBetterThanChance) {
  constexpr int kSeeds = 20;
  for (const std::uint64_t points : {4096U, 10'000U}) {
    double square = 0;
    LatticeRule rule(points);
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      rule.shift(seed, {});
      square += std::pow(pairwise(rule) - 1, 2) / kSeeds;
    }
    // Independent points: the main effects alone, a third of each coordinate's, 2 / 9 points.
    EXPECT_LT(square, 0.01 * 2.0 / (9.0 * static_cast<double>(points)));
  }
}

}  // namespace
}  // namespace clca::boltzmann::lattice_rule_test
