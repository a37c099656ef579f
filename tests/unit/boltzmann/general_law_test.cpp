#include "general_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "random_contacts.hpp"

namespace clca::boltzmann::general_law_test {
namespace {

using Eigen::Vector3d;

constexpr int kCases = 2000;
constexpr double kRounding = 1e-12;

/// Calls `check` with many cases, each with what the collision makes of it.
template <class Check>
void for_many(const Check& check) {
  RandomContacts random(1);
  for (int i = 0; i < kCases; ++i) {
    const Case one = random.any();
    check(one.law, one.pair, one.contact, collide(one.law, one.pair, one.contact));
  }
}

Vector3d momentum(const Pair& pair, const CollisionState& contact) {
  return pair.first.mass * contact.first.velocity + pair.second.mass * contact.second.velocity;
}

/// The first sphere is at `place` when they touch.
Vector3d angular_momentum(const Pair& pair, const CollisionState& contact, const Vector3d& place) {
  const Vector3d second = place + (pair.first.radius + pair.second.radius) * contact.normal;
  return pair.first.mass * place.cross(contact.first.velocity) +
         pair.second.mass * second.cross(contact.second.velocity) +
         pair.first.inertia * contact.first.spin + pair.second.inertia * contact.second.spin;
}

double translational_energy(const Pair& pair, const CollisionState& contact) {
  return (pair.first.mass * contact.first.velocity.squaredNorm() +
          pair.second.mass * contact.second.velocity.squaredNorm()) /
         2;
}

double rotational_energy(const Pair& pair, const CollisionState& contact) {
  return (pair.first.inertia * contact.first.spin.squaredNorm() +
          pair.second.inertia * contact.second.spin.squaredNorm()) /
         2;
}

TEST(GeneralLaw, KeepsMomentum) {
  for_many(
      [](const Law&, const Pair& pair, const CollisionState& before, const CollisionState& after) {
        EXPECT_LT((momentum(pair, after) - momentum(pair, before)).norm(),
                  kRounding * (1 + momentum(pair, before).norm()));
      });
}

TEST(GeneralLaw, KeepsAngularMomentumAboutAnyPoint) {
  RandomContacts places(2);
  for_many(
      [&](const Law&, const Pair& pair, const CollisionState& before, const CollisionState& after) {
        const Vector3d place = 10 * places.vector();
        const Vector3d expected = angular_momentum(pair, before, place);
        EXPECT_LT((angular_momentum(pair, after, place) - expected).norm(),
                  kRounding * (1 + expected.norm()));
      });
}

TEST(GeneralLaw, ReversesTheNormalSlipByTheRestitution) {
  for_many([](const Law& law, const Pair& pair, const CollisionState& before,
              const CollisionState& after) {
    const double expected = -law.restitution * before.slip(pair).dot(before.normal);
    EXPECT_NEAR(after.slip(pair).dot(before.normal), expected,
                kRounding * (1 + before.slip(pair).norm()));
  });
}

TEST(GeneralLaw, ScalesTheTangentialSlipByItsRatio) {
  for_many([](const Law& law, const Pair& pair, const CollisionState& before,
              const CollisionState& after) {
    const double ratio = tangential_ratio(law, pair, before);
    EXPECT_LT((tangential_slip(pair, after) - ratio * tangential_slip(pair, before)).norm(),
              kRounding * (1 + before.slip(pair).norm()));
  });
}

TEST(GeneralLaw, BrakesUntilItSticksOrRebounds) {
  int sliding = 0;
  for_many([&](const Law& law, const Pair& pair, const CollisionState& before,
               const CollisionState&) {
    const double normal = before.slip(pair).dot(before.normal);
    const double mu = 1 / (1 / pair.first.mass + 1 / pair.second.mass);
    const double k = 1 / mu + std::pow(pair.first.radius, 2) / pair.first.inertia +
                     std::pow(pair.second.radius, 2) / pair.second.inertia;
    const double braked = 1 - law.friction * k * mu * (1 + law.restitution) * normal /
                                  tangential_slip(pair, before).norm();
    EXPECT_NEAR(tangential_ratio(law, pair, before), std::max(-law.roughness, braked), kRounding);
    sliding += braked > -law.roughness ? 1 : 0;
  });
  EXPECT_GT(sliding, kCases / 10);
  EXPECT_LT(sliding, kCases * 9 / 10);
}

TEST(GeneralLaw, ChangesBothEnergiesAsOgawaAndKatoSay) {
  // Eqs. 24 to 26, C4 put right.
  for_many([](const Law& law, const Pair& pair, const CollisionState& before,
              const CollisionState& after) {
    const double mu = pair.reduced_mass();
    const double k = pair.compliance();
    const double braking = 1 - tangential_ratio(law, pair, before);
    const double c1 = mu / 2 * (1 - law.restitution * law.restitution);
    const double c2 = braking / k * (braking / k) / (2 * mu);
    const double c3 = braking / k;
    const double c4 = (k - 1 / mu) / 2 * (braking / k) * (braking / k);
    const Vector3d tangential = tangential_slip(pair, before);
    const Vector3d approach = before.first.velocity - before.second.velocity;
    const Vector3d spinning = before.slip(pair) - approach;
    const double normal = approach.dot(before.normal);
    const double scale = translational_energy(pair, before) + rotational_energy(pair, before);
    EXPECT_NEAR(
        translational_energy(pair, after) - translational_energy(pair, before),
        -c1 * normal * normal + c2 * tangential.squaredNorm() - c3 * tangential.dot(approach),
        kRounding * scale);
    EXPECT_NEAR(rotational_energy(pair, after) - rotational_energy(pair, before),
                c4 * tangential.squaredNorm() - c3 * tangential.dot(spinning), kRounding * scale);
  });
}

TEST(GeneralLaw, LosesWhatItSaysAndNeverGains) {
  for_many([](const Law& law, const Pair& pair, const CollisionState& before,
              const CollisionState& after) {
    const EnergyLoss loss = energy_loss(law, pair, before);
    const double energy = translational_energy(pair, before) + rotational_energy(pair, before);
    const double left = translational_energy(pair, after) + rotational_energy(pair, after);
    EXPECT_NEAR(loss.total(), energy - left, kRounding * energy);
    EXPECT_GE(loss.normal, 0);
    EXPECT_GE(loss.tangential, 0);
  });
}

TEST(GeneralLaw, DoesNotCareForTheUnitOfMass) {
  RandomContacts random(3);
  for (int i = 0; i < kCases; ++i) {
    const Case one = random.any();
    Pair heavy = one.pair;
    for (Sphere* sphere : {&heavy.first, &heavy.second}) {
      sphere->mass *= 1000;
      sphere->inertia *= 1000;
    }
    const double expected = friction_number(one.law, one.pair);
    EXPECT_NEAR(friction_number(one.law, heavy), expected, kRounding * expected);
  }
}

TEST(GeneralLaw, HasRoundNumbersForEqualSolidSpheres) {
  const Pair pair;
  const Law law = {.restitution = 0.5, .friction = 0.3};
  EXPECT_DOUBLE_EQ(pair.reduced_mass(), 0.5);
  EXPECT_DOUBLE_EQ(pair.compliance(), 7);
  EXPECT_DOUBLE_EQ(friction_number(law, pair), 3.5 * 0.3 * 1.5);
  RandomContacts random(4);
  for (int i = 0; i < kCases; ++i) {
    const CollisionState before = random.approaching(pair);
    const CollisionState after = collide(law, pair, before);
    const double braking = 1 - tangential_ratio(law, pair, before);
    const Vector3d tangential = tangential_slip(pair, before);
    const Vector3d impulse =
        0.75 * before.slip(pair).dot(before.normal) * before.normal + braking / 7 * tangential;
    const Vector3d angular_impulse = 5.0 / 14 * braking * before.normal.cross(tangential);
    EXPECT_TRUE(after.first.velocity.isApprox(before.first.velocity - impulse, kRounding));
    EXPECT_TRUE(after.second.velocity.isApprox(before.second.velocity + impulse, kRounding));
    EXPECT_TRUE(after.first.spin.isApprox(before.first.spin - angular_impulse, kRounding));
    EXPECT_TRUE(after.second.spin.isApprox(before.second.spin - angular_impulse, kRounding));
  }
}

TEST(GeneralLaw, SticksWhereNothingSlidesUnlessThereIsNoFriction) {
  CollisionState head_on;
  head_on.first.velocity = Vector3d::UnitX();
  EXPECT_EQ(tangential_ratio({.restitution = 0.5, .friction = 1e-3}, Pair{}, head_on), 0);
  EXPECT_EQ(tangential_ratio({.restitution = 0.5, .friction = 0}, Pair{}, head_on), 1);
}

TEST(GeneralLaw, LeavesSpinsAloneWithoutFriction) {
  RandomContacts random(5);
  for (int i = 0; i < kCases; ++i) {
    const CollisionState before = random.approaching(Pair{});
    const CollisionState after = collide({.restitution = 0.5}, Pair{}, before);
    EXPECT_EQ(after.first.spin, before.first.spin);
    EXPECT_EQ(after.second.spin, before.second.spin);
  }
}

TEST(GeneralLaw, HasAConstantTangentialRestitutionWhereNothingSlides) {
  RandomContacts random(6);
  for (int i = 0; i < kCases; ++i) {
    Case one = random.any();
    one.law.friction = kNoSlidingLimit;
    EXPECT_NEAR(tangential_ratio(one.law, one.pair, one.contact), -one.law.roughness, kRounding);
  }
}

TEST(GeneralLaw, SlidesAtGrazingContactsEvenWithARoughness) {
  const Law law = {.restitution = 0.9, .friction = 0.2, .roughness = 0.5};
  CollisionState grazing;
  grazing.first.velocity = {0.1, 1, 0};
  const double sliding = 1 - 3.5 * 0.2 * 1.9 * 0.1;
  EXPECT_NEAR(tangential_ratio(law, Pair{}, grazing), sliding, kRounding);
  CollisionState steep;
  steep.first.velocity = {1, 0.1, 0};
  EXPECT_NEAR(tangential_ratio(law, Pair{}, steep), -0.5, kRounding);
}

}  // namespace
}  // namespace clca::boltzmann::general_law_test
