// What passes between two bodies that touch. Bounds on rounding: a velocity is changed by a whole
// impulse, of 2^-23 unit of mass times spacing a step, and is rounded itself.

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "contact/rule/law.hpp"
#include "touching_pairs.hpp"

namespace clca::contact::contact_law_test {
namespace {

constexpr int kTrials = 3000;
constexpr UnitVector kUp = {0, 1 << kUnitBits};

/// A contact of hexagons, the other one under the upper one or, without it, the floor.
Pairing upright(int radius, std::optional<int> other) {
  return {.upper = {},
          .other = {},
          .normal_x = kUp.x,
          .normal_y = kUp.y,
          .coefficients = pair_of(radius, other)};
}

Impulse<Number> solved(Pairing& at, double friction, const LawConstants& law = {},
                       Number bounce = 0) {
  Impulse<Number> impulse;
  solve_contact(impulse, at, bounce, ratio(friction), law);
  return impulse;
}

TEST(EqualGrains, MeetingHeadOnPartWithTheRestitutionTimesTheirVelocity) {
  for (const int radius : {0, 1, 2, 5}) {
    for (const double restitution : {0.0, 0.3, 0.9}) {
      for (const double velocity : {0.02, 0.1, 0.7, 1.5}) {
        Pairing at = upright(radius, radius);
        at.upper.y = -length(velocity);
        at.other.y = length(velocity);
        const Number closing = -separation_velocity(at);
        ASSERT_EQ(closing, 2 * length(velocity));
        solved(at, 0.5, {.rotates = true}, bounce_velocity(closing, ratio(restitution)));
        EXPECT_NEAR(separation_velocity(at), restitution * closing, 4 + closing * 0x1p-16);
        EXPECT_NEAR(at.upper.y, -at.other.y, 1);
        EXPECT_EQ(at.upper.x, 0);
        EXPECT_EQ(at.upper.spin, 0);
      }
    }
  }
}

TEST(Grains, ThatCloseWithLessThanAThirtySecondOfASpacingAStepDoNotBounce) {
  EXPECT_EQ(bounce_velocity(kSpacing / 32, ratio(0.9)), 0);
  EXPECT_EQ(bounce_velocity(-kSpacing, ratio(0.9)), 0);
  EXPECT_NEAR(bounce_velocity(kSpacing / 32 + 1, ratio(0.5)), kSpacing / 64, 1);
}

TEST(Grains, ThatPartAlreadyGiveEachOtherNothing) {
  Pairing at = upright(1, 1);
  at.upper = {5000, 7000, 300};
  const Pairing before = at;
  EXPECT_EQ(solved(at, 0.5, {.rotates = true}), Impulse<Number>());
  EXPECT_EQ(at.upper, before.upper);
  EXPECT_EQ(at.other, before.other);
}

TEST(APair, KeepsItsMomentum) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::array<int, 2> radii = {static_cast<int>(random() % 6),
                                      static_cast<int>(random() % 6)};
    const UnitVector normal = any_normal(random);
    Pairing at = {.upper = any_velocity(random, kSpacing),
                  .other = any_velocity(random, kSpacing),
                  .normal_x = normal.x,
                  .normal_y = normal.y,
                  .coefficients = pair_of(radii[0], radii[1])};
    const double one = sites_of(radii[0]);
    const double other = sites_of(radii[1]);
    const auto momentum = [&] {
      return std::array{one * at.upper.x + other * at.other.x,
                        one * at.upper.y + other * at.other.y};
    };
    const auto before = momentum();
    const Impulse<Number> impulse =
        solved(at, 0.5, {.rotates = true, .resists_rolling = true, .rolling_friction = ratio(0.5)},
               static_cast<Number>(random() % kSpacing));
    const auto after = momentum();
    // Half a unit of each velocity, and of each inverse mass.
    const double inverse =
        0.5 * std::ldexp(1.0, -kInverseMassBits) * std::hypot(impulse.normal, impulse.shear);
    const double rounding = (0.5 + inverse) * (one + other);
    EXPECT_NEAR(after[0], before[0], rounding);
    EXPECT_NEAR(after[1], before[1], rounding);
  }
}

/// Angular momentum about the contact of what turns, without that of the motion: of a disc half of
/// mass times radius times spin.
double spin_moment(const Pairing& at, double one, double other) {
  return 0.5 * (std::pow(one, 1.5) * at.upper.spin + std::pow(other, 1.5) * at.other.spin);
}

TEST(AMoment, TakesFromOneGrainWhatItGivesTheOther) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::array<int, 2> radii = {static_cast<int>(random() % 6),
                                      static_cast<int>(random() % 6)};
    Pairing at = upright(radii[0], radii[1]);
    at.upper.spin = any_velocity(random, kSpacing).spin;
    at.other.spin = any_velocity(random, kSpacing).spin;
    const double one = sites_of(radii[0]);
    const double other = sites_of(radii[1]);
    const double before = spin_moment(at, one, other);
    const Number rolling = any_velocity(random, kSpacing).x;
    apply_impulse(at, {.normal = 0, .shear = 0, .rolling = rolling}, true);
    // What turns is held halved.
    const double inverse = std::ldexp(1.0, -kInverseMassBits) * std::abs(rolling);
    EXPECT_NEAR(spin_moment(at, one, other), before,
                0.5 * (0.5 + inverse) * (std::pow(one, 1.5) + std::pow(other, 1.5)));
  }
}

// 0.3 of the normal mass; half of it would stop a disc at once.
TEST(AMoment, OnTheFloorSlowsTheSpinOfAGrainOfAnySizeAlike) {
  for (const int radius : {0, 1, 2, 8}) {
    Pairing at = upright(radius, std::nullopt);
    at.upper = {0, -kSpacing, kSpacing / 4};
    solved(at, 0, {.rotates = true, .resists_rolling = true, .rolling_friction = ratio(1)});
    EXPECT_NEAR(at.upper.spin, (1 - 2 * 0.3) * kSpacing / 4, kSpacing * 0x1p-9) << radius;
  }
}

/// What a coefficient, rounded to 2^-16, allows.
double most(double friction, Number normal) {
  return std::ldexp(ratio(friction), -kRatioBits) * normal + 0.5;
}

TEST(Friction, NeverExceedsItsCoefficientTimesTheNormalImpulse) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < kTrials; ++trial) {
    const UnitVector normal = any_normal(random);
    const bool turns = trial % 2 == 0;
    Pairing at = {.upper = any_velocity(random, kSpacing),
                  .other = any_velocity(random, kSpacing),
                  .normal_x = normal.x,
                  .normal_y = normal.y,
                  .coefficients = pair_of(1, static_cast<int>(random() % 4))};
    const double friction = static_cast<double>(random() % 1000) / 500;
    const Impulse<Number> impulse = solved(at, friction, {.rotates = turns});
    EXPECT_LE(std::abs(impulse.shear), most(friction, impulse.normal));
  }
}

// 2/7 of the normal mass; all of it would stop a grain that does not turn at once, a third a disc.
TEST(Friction, SlowsSlipAsASpringDoesWhereItsBoundAllows) {
  for (const Rolling rolling : {Rolling::none, Rolling::free}) {
    for (const std::optional<int> other : {std::optional<int>(2), std::optional<int>()}) {
      Pairing at = upright(1, other);
      at.upper = {kSpacing / 16, -kSpacing, 0};
      const Impulse<Number> impulse = solved(at, 0.5, {.rotates = rolling != Rolling::none});
      EXPECT_LT(std::abs(impulse.shear), impulse.normal / 2);
      // The slip of the upper one against the normal turned anticlockwise. Masses are rounded.
      const double left = rolling == Rolling::none ? 5.0 / 7 : 1.0 / 7;
      EXPECT_NEAR(slip_velocity(at), -left * kSpacing / 16, kSpacing * 0x1p-13);
    }
  }
}

TEST(Friction, SlowsASlipThatItCannotStop) {
  Pairing at = upright(1, std::nullopt);
  at.upper = {kSpacing, -kSpacing / 16, 0};
  const Impulse<Number> impulse = solved(at, 0.5);
  EXPECT_NEAR(std::abs(impulse.shear), impulse.normal * 0.5, 1);
  EXPECT_NEAR(at.upper.x, kSpacing - kSpacing / 32, 2);
}

TEST(AGrain, ThatRollsWithoutSlipFeelsNoFriction) {
  Pairing at = upright(2, std::nullopt);
  // Anticlockwise is to the left on the floor.
  at.upper = {kSpacing / 8, -kSpacing / 64, -kSpacing / 8};
  ASSERT_EQ(slip_velocity(at), 0);
  const Impulse<Number> impulse = solved(at, 0.5, {.rotates = true});
  EXPECT_GT(impulse.normal, 0);
  EXPECT_EQ(impulse.shear, 0);
  EXPECT_EQ(at.upper.x, kSpacing / 8);
  EXPECT_EQ(at.upper.spin, -kSpacing / 8);
}

TEST(RollingResistance, NeverExceedsItsCoefficientTimesTheNormalImpulse) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < kTrials; ++trial) {
    const UnitVector normal = any_normal(random);
    Pairing at = {.upper = any_velocity(random, kSpacing),
                  .other = any_velocity(random, kSpacing),
                  .normal_x = normal.x,
                  .normal_y = normal.y,
                  .coefficients = pair_of(static_cast<int>(random() % 4), 2)};
    const double friction = static_cast<double>(random() % 1000) / 500;
    const Impulse<Number> impulse = solved(
        at, 0.3, {.rotates = true, .resists_rolling = true, .rolling_friction = ratio(friction)});
    EXPECT_LE(std::abs(impulse.rolling), most(friction, impulse.normal));
  }
}

TEST(AWall, IsNotMoved) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < kTrials; ++trial) {
    const UnitVector normal = any_normal(random);
    Pairing at = {.upper = any_velocity(random, kSpacing),
                  .other = {},
                  .normal_x = normal.x,
                  .normal_y = normal.y,
                  .coefficients = pair_of(static_cast<int>(random() % 4), std::nullopt)};
    solved(at, 0.5, {.rotates = true, .resists_rolling = true, .rolling_friction = ratio(0.5)});
    EXPECT_EQ(at.other, Velocity<Number>());
    EXPECT_GE(separation_velocity(at), -kSpacing * 0x1p-9) << "nothing enters a wall";
  }
}

// Built with the sanitizer of undefined behaviour this finds any product that overflows.
TEST(ExtremeValues, StayWithinTheirBounds) {
  std::mt19937_64 random(6);
  constexpr int kLarge = 182;  // about 100,000 sites
  const auto extreme = [&](Number most) {
    const std::array<Number, 3> values = {-most, 0, most};
    return values[random() % 3];
  };
  std::vector<PairCoefficients> pairs;
  for (const int radius : {0, kLarge}) {
    for (const std::optional<int> other :
         {std::optional<int>(0), std::optional<int>(kLarge), std::optional<int>()}) {
      pairs.push_back(pair_of(radius, other));
    }
  }
  const auto within = [](const Velocity<Number>& velocity) {
    return std::max({std::abs(velocity.x), std::abs(velocity.y), std::abs(velocity.spin)}) <=
           kMaxVelocity;
  };
  for (int trial = 0; trial < 10 * kTrials; ++trial) {
    const UnitVector normal = trial % 2 == 0 ? kUp : any_normal(random);
    Pairing at = {.upper = {extreme(kMaxVelocity), extreme(kMaxVelocity), extreme(kMaxVelocity)},
                  .other = {extreme(kMaxVelocity), extreme(kMaxVelocity), extreme(kMaxVelocity)},
                  .normal_x = normal.x,
                  .normal_y = normal.y,
                  .coefficients = pairs[random() % pairs.size()]};
    if (at.coefficients.other_inverse_mass == 0) {
      at.other = {};
    }
    Impulse<Number> impulse = {std::max(0, extreme(kMaxImpulse)), extreme(kMaxImpulse),
                               extreme(kMaxImpulse)};
    const LawConstants law = {.rotates = true,
                              .resists_rolling = true,
                              .rolling_friction = ratio(random() % 2 == 0 ? 1e9 : 0)};
    const Number closing = -separation_velocity(at);
    apply_impulse(at, impulse, true);
    solve_contact(impulse, at, bounce_velocity(closing, ratio(0.99)),
                  ratio(random() % 2 == 0 ? 1e9 : 0), law);
    EXPECT_TRUE(within(at.upper) && within(at.other));
    EXPECT_GE(impulse.normal, 0);
    EXPECT_LE(std::max({impulse.normal, std::abs(impulse.shear), std::abs(impulse.rolling)}),
              kMaxImpulse);
  }
}

}  // namespace
}  // namespace clca::contact::contact_law_test
