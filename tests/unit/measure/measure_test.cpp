#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clca/measure/displacement.hpp"
#include "clca/measure/outflow.hpp"
#include "clca/measure/profile.hpp"
#include "support/states.hpp"

namespace clca::measure::measure_test {
namespace {

using grains::State;
using lattice::kColumnPitch;
using lattice::Shape;
using testing::empty_state;

/// Single sites stacked without gaps: `heights[c]` of them in column c.
State stacks(const std::vector<int>& heights) {
  State state = empty_state(static_cast<int>(heights.size()), 100);
  state.kinds = {{Shape::hexagon(0), 0}};
  for (std::size_t column = 0; column < heights.size(); ++column) {
    for (int row = 0; row < heights[column]; ++row) {
      state.particles.push_back({.column = static_cast<int>(column), .row = row});
      state.origins.push_back({static_cast<int>(column), row});
    }
  }
  return state;
}

TEST(Profile, IsTheTopOfTheHighestSiteOfEachColumn) {
  const auto profile = surface_profile(stacks({3, 2, 0, 1}));
  EXPECT_THAT(profile, ::testing::ElementsAre(3, 2.5, 0, 1.5));  // odd columns stand half higher
  EXPECT_DOUBLE_EQ(mean_height(profile), 7.0 / 3.0);
}

TEST(Profile, InGravityOfAnUprightBoxIsThatOfTheBox) {
  std::vector<int> heights;
  for (int column = 0; column < 60; ++column) {
    heights.push_back(1 + column % 7);
  }
  for (const int empty : {0, 1, 2, 5}) {  // columns at the left, so that the edges are elsewhere
    std::fill_n(heights.begin(), empty, 0);
    const State state = stacks(heights);
    const std::vector<double> profile = surface_profile(state);
    EXPECT_EQ(surface_profile(state, {0, -1}),
              std::vector<double>(profile.begin() + empty, profile.end()));
  }
}

TEST(Profile, OfAnEmptyBoxIsZero) {
  const auto profile = surface_profile(stacks({0, 0}));
  EXPECT_EQ(mean_height(profile), 0);
  EXPECT_FALSE(repose_angle(profile).mean_degrees().has_value());
}

TEST(Repose, AStraightFlankHasTheAngleOfItsSlope) {
  for (const double angle : {10.0, 30.0, 45.0, 60.0}) {
    const double slope = std::tan(angle * std::numbers::pi / 180);
    std::vector<double> wedge;
    for (int column = 0; column < 200; ++column) {
      wedge.push_back(std::max(0.0, 50 - slope * kColumnPitch * column));
    }
    const ReposeAngle found = repose_angle(wedge);
    EXPECT_NEAR(found.right.degrees.value(), angle, 1e-9);
    EXPECT_FALSE(found.left.degrees.has_value());
    const ReposeAngle mirrored = repose_angle({wedge.rbegin(), wedge.rend()});
    EXPECT_NEAR(mirrored.left.degrees.value(), angle, 1e-9);
  }
}

TEST(Repose, AFlatTopAndAThinToeDoNotSpoilTheAngle) {
  std::vector<double> profile(60, 50.0);
  for (int column = 1; column <= 58; ++column) {
    profile.push_back(50 - std::tan(std::numbers::pi / 4) * kColumnPitch * column);
  }
  profile.resize(250, 2.0);
  EXPECT_NEAR(repose_angle(profile).right.degrees.value(), 45, 0.01);
}

TEST(Repose, TheFlankIsFrom15To80PercentOfTheHeight) {
  // 100 high, of 45 degrees between two heights and flatter outside.
  const auto angle = [](double low, double high) {
    std::vector<double> profile(3, 100.0);
    while (profile.back() > 0) {
      const bool is_flank = profile.back() < high && profile.back() > low;
      profile.push_back(profile.back() - (is_flank ? 1 : 0.3) * kColumnPitch);
    }
    return repose_angle(profile).right.degrees.value();
  };
  EXPECT_NEAR(angle(15, 80), 45, 1e-9);
  EXPECT_LT(angle(17, 80), 44.9);
  EXPECT_LT(angle(15, 78), 44.9);
}

TEST(Repose, AHeapHasTwoFlanksAndAFlatBedHasNone) {
  std::vector<double> heap;
  for (int column = -60; column <= 60; ++column) {
    heap.push_back(50 - (column < 0 ? 0.5 : 0.8) * std::abs(column));
  }
  const ReposeAngle angle = repose_angle(heap);
  EXPECT_NEAR(angle.left.degrees.value(), std::atan(0.5 / kColumnPitch) * 180 / std::numbers::pi,
              1e-9);
  EXPECT_NEAR(angle.right.degrees.value(), std::atan(0.8 / kColumnPitch) * 180 / std::numbers::pi,
              1e-9);
  EXPECT_FALSE(repose_angle(std::vector<double>(80, 30.0)).mean_degrees().has_value());
}

TEST(Repose, TwoHeapsAreNoFlank) {
  // Of 45 degrees each, the one on the right smaller.
  std::vector<double> profile(130, 0.0);
  for (int column = 0; column < 130; ++column) {
    const double left = 60 - kColumnPitch * column;
    const double right = 40 - kColumnPitch * std::abs(column - 100);
    profile[static_cast<std::size_t>(column)] = std::max({0.0, left, right});
  }
  const ReposeAngle angle = repose_angle(profile);
  EXPECT_FALSE(angle.right.degrees.has_value());
  EXPECT_TRUE(angle.right.is_uneven);
  EXPECT_FALSE(angle.left.degrees.has_value());
  EXPECT_FALSE(angle.left.is_uneven);  // there is none
}

/// A pile that falls to the right by 40 degrees, in a vessel turned by some degrees anticlockwise.
TEST(Repose, AgainstGravityIsWhatTheVesselTurnsItBy) {
  constexpr double kDegree = std::numbers::pi / 180;
  std::vector<int> heights;
  for (int column = 0; column < 80; ++column) {
    heights.push_back(std::max(0, 60 - static_cast<int>(std::tan(40 * kDegree) * kColumnPitch *
                                                        static_cast<double>(column))));
  }
  const State state = stacks(heights);
  for (const double turned : {-20.0, 0.0, 25.0}) {
    const Eigen::Vector2d down(-std::sin(turned * kDegree), -std::cos(turned * kDegree));
    const ReposeAngle angle = repose_angle(surface_profile(state, down));
    EXPECT_NEAR(angle.right.degrees.value(), 40 - turned, 1.5) << turned;
  }
  EXPECT_TRUE(surface_profile(stacks({0, 0}), {0, -1}).empty());
}

TEST(Packing, IsOneForGaplessStacksAndCountsHolesBelowTheSurface) {
  EXPECT_DOUBLE_EQ(packing_fraction(stacks({5, 7, 3})).value(), 1);
  State state = stacks({5, 5});
  state.particles.erase(state.particles.begin() + 2);
  EXPECT_DOUBLE_EQ(packing_fraction(state).value(), 0.9);
  EXPECT_FALSE(packing_fraction(stacks({0, 0})).has_value());
}

TEST(Packing, LeavesOutWallsAndWhatIsUnderThem) {
  State state = empty_state(2, 20);
  state.kinds = {{Shape::hexagon(0), 0}};
  state.walls = {{.sites = {{0, 4}, {1, 4}, {0, 7}}, .present = true}};
  state.particles = {{.column = 0, .row = 5}, {.column = 0, .row = 9}, {.column = 1, .row = 5}};
  // Column 0: rows 5 to 9 less the wall at 7; column 1: row 5.
  EXPECT_DOUBLE_EQ(packing_fraction(state).value(), 3.0 / 5.0);
}

TEST(Packing, CountsASiteOfTwoWallsOnce) {
  State state = empty_state(2, 20);
  state.kinds = {{Shape::hexagon(0), 0}};
  state.walls = {{.sites = {{0, 4}, {0, 7}}, .present = true},
                 {.sites = {{0, 7}}, .present = true}};
  state.particles = {{.column = 0, .row = 5}, {.column = 0, .row = 9}};
  EXPECT_DOUBLE_EQ(packing_fraction(state).value(), 2.0 / 4.0);
}

TEST(Displacement, IsTheDistanceFromTheOrigin) {
  State state = stacks({1, 1, 1, 1});
  state.origins = {{0, 3}, {1, 0}, {0, 0}, {3, 0}};
  const auto moved = distances_from_origins(state);
  EXPECT_DOUBLE_EQ(moved[0], 3);
  EXPECT_DOUBLE_EQ(moved[1], 0);
  EXPECT_NEAR(moved[2], std::sqrt(3.0), 1e-12);
  EXPECT_EQ(moved_share(state, 1.7), 0.5);
  EXPECT_EQ(moved_share(state, 3), 0);
  for (grains::Particle& particle : state.particles) {
    particle.present = false;
  }
  EXPECT_EQ(moved_share(state, 3), std::nullopt);
}

TEST(MovedShare, IsTheSameForEqualDistancesInAllDirections) {
  for (const lattice::Direction direction : lattice::kDirections) {
    for (int distance = 1; distance < 50; ++distance) {
      State state = empty_state(400, 400);
      state.kinds = {{Shape::hexagon(0), 0}};
      const lattice::Axial one = unit(direction);
      const lattice::Site from = {200, 200};
      const lattice::Site to = from + lattice::Axial{distance * one.x, distance * one.q};
      state.particles = {{.column = to.column, .row = to.row}};
      state.origins = {from};
      EXPECT_EQ(moved_share(state, distance), 0);
      EXPECT_EQ(distances_from_origins(state)[0], distance);
    }
  }
}

TEST(Displacement, SmallestDiameterIsThatOfTheCircleOfEqualArea) {
  State state = empty_state(9, 9);
  state.kinds = {{Shape::hexagon(2), 0}, {Shape::hexagon(1), 1}};
  EXPECT_NEAR(smallest_kind_diameter(state), 2.778, 1e-3);
}

TEST(Runout, IsMeasuredBeyondWhereTheMaterialStood) {
  State state = stacks(std::vector<int>(300, 1));
  for (std::size_t id = 0; id < 300; ++id) {
    state.origins[id] = {100 + static_cast<int>(id) / 3, 0};  // columns 100 to 199
  }
  const Runout spread = runout(state).value();
  EXPECT_NEAR(spread.front, 100 * kColumnPitch, 1e-9);
  EXPECT_NEAR(spread.percentile_99, 98 * kColumnPitch, 1e-9);  // 1 % of 300 sites: two columns less
  EXPECT_TRUE(spread.reaches_side);
  EXPECT_FALSE(runout(stacks({0})).has_value());
}

TEST(Runout, IsEndedByASideOfTheBoxWhereGrainsHaveComeToIt) {
  State state = stacks({0, 1, 1, 1, 0});
  for (int id = 0; id < 3; ++id) {
    state.origins[static_cast<std::size_t>(id)] = {2, id};
  }
  EXPECT_FALSE(runout(state)->reaches_side);
  state = stacks({0, 1, 1, 1});
  for (int id = 0; id < 3; ++id) {
    state.origins[static_cast<std::size_t>(id)] = {2, id};
  }
  EXPECT_TRUE(runout(state)->reaches_side);
  state.origins = {{1, 0}, {2, 0}, {3, 0}};
  EXPECT_FALSE(runout(state)->reaches_side) << "they stood there";
}

TEST(Outflow, IsTheRateOfTheSteadyPart) {
  Outflow outflow({.particles = 10, .sites = 70});
  std::uint64_t sites = 0;
  for (int step = 0; step < 300; ++step) {
    sites += step < 20 ? 0 : step < 220 ? 12 : 1;  // a start, a steady flow, a trickle
    outflow.add({.particles = 10 + sites / 7, .sites = 70 + sites});
  }
  EXPECT_NEAR(outflow.sites_per_step(), 12, 0.1);
  EXPECT_EQ(outflow.stage_discharge().sites, sites);
}

TEST(Outflow, TheSteadyPartIsFrom20To70PercentOfWhatLeaves) {
  Outflow outflow;
  std::uint64_t sites = 0;
  while (sites < 1000) {
    sites += sites >= 200 && sites < 700 ? 10 : 1;
    outflow.add({.particles = sites / 5, .sites = sites});
  }
  EXPECT_EQ(outflow.sites_per_step(), 10);
}

TEST(Outflow, OnlyPrecedesAStateFromWhichAsMuchHasLeft) {
  State state = empty_state(4, 4);
  Outflow outflow;
  EXPECT_TRUE(outflow.precedes(discharge(state)));
  state.outlets.push_back({.region = {}, .particles = 2, .sites = 14});
  EXPECT_FALSE(outflow.precedes(discharge(state)));
  outflow.add({.particles = 2, .sites = 14});
  EXPECT_TRUE(outflow.precedes(discharge(state)));
  state.outlets.front().sites = 15;
  EXPECT_FALSE(outflow.precedes(discharge(state)));
}

TEST(Outflow, IsCountedByOutletAndSpecies) {
  State state = empty_state(40, 40);
  state.kinds = {{Shape::hexagon(0), 0}, {Shape::hexagon(1), 1}, {Shape::hexagon(1), 1}};
  state.outlets = {{.region = {0, 0, 10, 40}}, {.region = {5, 0, 40, 40}}};
  state.particles = {
      {.column = 2, .row = 2, .kind = 0, .present = false},
      {.column = 8, .row = 2, .kind = 1, .present = false},   // the first of both
      {.column = 11, .row = 2, .kind = 2, .present = false},  // sticks out of the first
      {.column = 30, .row = 2, .kind = 0, .present = false},
      {.column = 2, .row = 9, .kind = 1}};
  EXPECT_EQ(discharged_counts(state, 2), (std::vector<std::uint64_t>{1, 1, 1, 1}));
  state.outlets.pop_back();
  EXPECT_THROW(discharged_counts(state, 2), std::invalid_argument);
}

TEST(Outflow, OfNothingIsZero) {
  Outflow outflow;
  EXPECT_EQ(outflow.sites_per_step(), 0);
  outflow.add({});
  EXPECT_EQ(outflow.sites_per_step(), 0);
}

}  // namespace
}  // namespace clca::measure::measure_test
