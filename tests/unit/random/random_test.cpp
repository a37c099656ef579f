#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "clca/random/draw.hpp"

namespace clca::random::random_test {
namespace {

TEST(Draw, MatchesTheKnownAnswerOfPhilox) {
  // Random123's kat_vectors, philox4x32 with 10 rounds, counter and key all zero: 6627e8d5
  // e169c58d. Purpose 0 is not used by the program, so that it can stand for the zero counter word
  // here.
  EXPECT_EQ(draw(0, 0, 0, static_cast<Purpose>(0)), 0xe169c58d6627e8d5U);
}

TEST(Draw, DependsOnEachOfItsArguments) {
  const std::set<std::uint64_t> draws = {draw(1, 1, 1, Purpose::coin),
                                         draw(2, 1, 1, Purpose::coin),
                                         draw(1ULL << 32U, 1, 1, Purpose::coin),
                                         draw(1, 2, 1, Purpose::coin),
                                         draw(1, 1ULL << 32U, 1, Purpose::coin),
                                         draw(1, 1, 2, Purpose::coin),
                                         draw(1, 1, 1, Purpose::tie)};
  EXPECT_EQ(draws.size(), 7U);
}

TEST(Draw, IsUniformOverSixteenBins) {
  constexpr int kDraws = 160'000;
  std::array<int, 16> counts{};
  for (std::uint32_t item = 0; item < kDraws; ++item) {
    ++counts.at(uniform_below(draw(7, 3, item, Purpose::coin), 16));
  }
  double chi_square = 0;
  for (const int count : counts) {
    chi_square += std::pow(count - kDraws / 16.0, 2) / (kDraws / 16.0);
  }
  EXPECT_LT(chi_square, 37.7);  // 99.9 % quantile for 15 degrees of freedom
}

TEST(Below, ReachesBothEndsAndStaysBelow) {
  EXPECT_EQ(uniform_below(0, 6), 0U);
  EXPECT_EQ(uniform_below(~std::uint64_t{0}, 6), 5U);
  EXPECT_EQ(uniform_below(~std::uint64_t{0}, 1), 0U);
}

TEST(Probability, ZeroNeverAcceptsAndOneAlwaysDoes) {
  EXPECT_FALSE(Probability(0).accepts(0));
  EXPECT_TRUE(Probability(1).accepts(~std::uint64_t{0}));
}

TEST(Probability, AcceptsItsShareOfDraws) {
  const Probability probability(0.3);
  int accepted = 0;
  for (std::uint32_t item = 0; item < 100'000; ++item) {
    accepted += probability.accepts(draw(1, 0, item, Purpose::inertia)) ? 1 : 0;
  }
  EXPECT_NEAR(accepted, 30'000, 4 * std::sqrt(100'000 * 0.3 * 0.7));
}

TEST(Probability, RefusesWhatIsNone) {
  EXPECT_THROW(Probability(-0.1), std::invalid_argument);
  EXPECT_THROW(Probability(1.1), std::invalid_argument);
  EXPECT_THROW(Probability(NAN), std::invalid_argument);
}

}  // namespace
}  // namespace clca::random::random_test
