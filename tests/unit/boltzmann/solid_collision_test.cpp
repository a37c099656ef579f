#include "boltzmann/rule/solid_collision.hpp"

#include <gtest/gtest.h>

#include "general_law.hpp"
#include "random_contacts.hpp"

namespace clca::boltzmann::solid_collision_test {
namespace {

constexpr Law kPaper = {.restitution = 0.5, .friction = 0.3};
const Vectors<1> kAlongX = {1, 0, 0};

void expect_near(const Vectors<1>& found, const Vectors<1>& expected) {
  EXPECT_TRUE(((found - expected).abs() <= 1e-15).all()) << found << " not " << expected;
}

TEST(SolidCollision, SticksWhereFrictionSuffices) {
  // V = (2, 2, 0), A = 1.575 > |V_t| / g_n = 1: R = 0.
  const auto exchange = solid_collision<1>(kPaper, {2, 1, 0}, {0, 0, 1}, kAlongX);
  expect_near(exchange.impulse, {1.5, 2.0 / 7, 0});
  expect_near(exchange.angular_impulse, {0, 0, 2.0 / 7});
}

TEST(SolidCollision, SlidesWhereFrictionDoesNotSuffice) {
  // V = (1, 0, 2): 1 - R = 1.575 / 2.
  const auto exchange = solid_collision<1>(kPaper, {1, 0, 3}, {0, 1, 0}, kAlongX);
  expect_near(exchange.impulse, {0.75, 0, 0.225});
  expect_near(exchange.angular_impulse, {0, -0.225, 0});
}

TEST(SolidCollision, ReversesTheSlipOfPerfectlyRoughSpheres) {
  const Law rough = {.restitution = 1, .friction = kNoSlidingLimit, .roughness = 1};
  const auto exchange = solid_collision<1>(rough, {1, 1, 0}, {0, 0, 0}, kAlongX);
  expect_near(exchange.impulse, {1, 2.0 / 7, 0});
  expect_near(exchange.angular_impulse, {0, 0, 2.0 / 7});
}

TEST(SolidCollision, OnlyPushesWhereNothingSlips) {
  for (const double friction : {0.0, 0.3, kNoSlidingLimit}) {
    const Law law = {.restitution = 0.5, .friction = friction};
    const auto exchange = solid_collision<1>(law, {2, 1, 0}, {0, 0, -1}, kAlongX);
    expect_near(exchange.impulse, {1.5, 0, 0});
    expect_near(exchange.angular_impulse, {0, 0, 0});
  }
}

TEST(SolidCollision, IsTheGeneralLawForEqualSolidSpheres) {
  RandomContacts random(9);
  const auto components = [](const Eigen::Vector3d& v) -> Vectors<1> { return v.transpose(); };
  for (int i = 0; i < 2000; ++i) {
    Case one = random.any();
    one.pair = {};
    one.contact = random.approaching(one.pair);
    const auto& [first, second, normal] = one.contact;
    const CollisionState after = collide(one.law, one.pair, one.contact);
    const auto impulses =
        solid_collision<1>(one.law, components(first.velocity - second.velocity),
                           components(first.spin + second.spin), components(normal));
    const Eigen::Vector3d impulse = impulses.impulse.matrix().transpose();
    const Eigen::Vector3d turn = kInverseInertia * impulses.angular_impulse.matrix().transpose();
    EXPECT_LT((after.first.velocity - (first.velocity - impulse)).norm(), 1e-12);
    EXPECT_LT((after.second.velocity - (second.velocity + impulse)).norm(), 1e-12);
    EXPECT_LT((after.first.spin - (first.spin - turn)).norm(), 1e-12);
    EXPECT_LT((after.second.spin - (second.spin - turn)).norm(), 1e-12);
    EXPECT_NEAR(friction_number(one.law), friction_number(one.law, one.pair), 1e-14);
  }
}

TEST(SolidCollision, GivesTheSameBitsForManyPairsAtOnce) {
  Vectors<4> g;
  Vectors<4> spins;
  Vectors<4> normal;
  g << 2, 1, 0, 1, 0, 3, 0.7, -0.4, 1.1, 0.3, 0.1, 0.2;
  spins << 0, 0, 1, 0, 1, 0, 1.3, 0.6, -0.9, -2, 1, 0.5;
  normal << 1, 0, 0, 1, 0, 0, 0.6, 0, 0.8, 0.8, 0.6, 0;
  const ImpulsePair<4> many = solid_collision(kPaper, g, spins, normal);
  for (int i = 0; i < 4; ++i) {
    const auto one = solid_collision<1>(kPaper, g.row(i), spins.row(i), normal.row(i));
    EXPECT_TRUE((one.impulse == many.impulse.row(i)).all())
        << one.impulse << " / " << many.impulse.row(i);
    EXPECT_TRUE((one.angular_impulse == many.angular_impulse.row(i)).all())
        << one.angular_impulse << " / " << many.angular_impulse.row(i);
  }
}

}  // namespace
}  // namespace clca::boltzmann::solid_collision_test
