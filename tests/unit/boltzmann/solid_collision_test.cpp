#include "boltzmann/rule/solid_collision.hpp"

#include <gtest/gtest.h>

#include "general_law.hpp"
#include "random_contacts.hpp"

namespace clca::boltzmann::solid_collision_test {
namespace {

using Many = Eigen::Array<double, 4, 1>;

constexpr Law kPaper = {.restitution = 0.5, .friction = 0.3};
constexpr Vector3<double> kAlongX = {1, 0, 0};

void expect_near(const Vector3<double>& found, const Vector3<double>& expected) {
  EXPECT_NEAR(found.x, expected.x, 1e-15);
  EXPECT_NEAR(found.y, expected.y, 1e-15);
  EXPECT_NEAR(found.z, expected.z, 1e-15);
}

TEST(SolidCollision, SticksWhereFrictionSuffices) {
  // V = (2, 2, 0), A = 1.575 > |V_t| / g_n = 1: R = 0.
  const auto exchange = solid_collision<double>(kPaper, {2, 1, 0}, {0, 0, 1}, kAlongX);
  expect_near(exchange.push, {1.5, 2.0 / 7, 0});
  expect_near(exchange.twist, {0, 0, 2.0 / 7});
}

TEST(SolidCollision, SlidesWhereFrictionDoesNotSuffice) {
  // V = (1, 0, 2): 1 - R = 1.575 / 2.
  const auto exchange = solid_collision<double>(kPaper, {1, 0, 3}, {0, 1, 0}, kAlongX);
  expect_near(exchange.push, {0.75, 0, 0.225});
  expect_near(exchange.twist, {0, -0.225, 0});
}

TEST(SolidCollision, ReversesTheSlipOfPerfectlyRoughSpheres) {
  const Law rough = {.restitution = 1, .friction = kNoSlidingLimit, .roughness = 1};
  const auto exchange = solid_collision<double>(rough, {1, 1, 0}, {0, 0, 0}, kAlongX);
  expect_near(exchange.push, {1, 2.0 / 7, 0});
  expect_near(exchange.twist, {0, 0, 2.0 / 7});
}

TEST(SolidCollision, OnlyPushesWhereNothingSlips) {
  for (const double friction : {0.0, 0.3, kNoSlidingLimit}) {
    const Law law = {.restitution = 0.5, .friction = friction};
    const auto exchange = solid_collision<double>(law, {2, 1, 0}, {0, 0, -1}, kAlongX);
    expect_near(exchange.push, {1.5, 0, 0});
    expect_near(exchange.twist, {0, 0, 0});
  }
}

TEST(SolidCollision, IsTheGeneralLawForEqualSolidSpheres) {
  RandomContacts random(9);
  const auto components = [](const Eigen::Vector3d& v) {
    return Vector3<double>{v.x(), v.y(), v.z()};
  };
  const auto vector = [](const Vector3<double>& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  for (int i = 0; i < 2000; ++i) {
    Case one = random.any();
    one.pair = {};
    one.contact = random.approaching(one.pair);
    const auto& [first, second, normal] = one.contact;
    const CollisionState after = collide(one.law, one.pair, one.contact);
    const auto impulses =
        solid_collision<double>(one.law, components(first.velocity - second.velocity),
                                components(first.spin + second.spin), components(normal));
    const Eigen::Vector3d push = vector(impulses.push);
    const Eigen::Vector3d turn = kSolidSpin * vector(impulses.twist);
    EXPECT_LT((after.first.velocity - (first.velocity - push)).norm(), 1e-12);
    EXPECT_LT((after.second.velocity - (second.velocity + push)).norm(), 1e-12);
    EXPECT_LT((after.first.spin - (first.spin - turn)).norm(), 1e-12);
    EXPECT_LT((after.second.spin - (second.spin - turn)).norm(), 1e-12);
    EXPECT_NEAR(friction_number(one.law), friction_number(one.law, one.pair), 1e-14);
  }
}

TEST(SolidCollision, GivesTheSameBitsForManyPairsAtOnce) {
  const Vector3<Many> g = {Many(2, 1, 0.7, 0.3), Many(1, 0, -0.4, 0.1), Many(0, 3, 1.1, 0.2)};
  const Vector3<Many> spins = {Many(0, 0, 1.3, -2), Many(0, 1, 0.6, 1), Many(1, 0, -0.9, 0.5)};
  const Vector3<Many> normal = {Many(1, 1, 0.6, 0.8), Many(0, 0, 0, 0.6), Many(0, 0, 0.8, 0)};
  const ImpulsePair<Many> many = solid_collision(kPaper, g, spins, normal);
  const auto lane = [](const Vector3<Many>& of, int i) {
    return Vector3<double>{of.x[i], of.y[i], of.z[i]};
  };
  const auto expect_equal = [](const Vector3<double>& a, const Vector3<double>& b) {
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
    EXPECT_EQ(a.z, b.z);
  };
  for (int i = 0; i < 4; ++i) {
    const auto one = solid_collision(kPaper, lane(g, i), lane(spins, i), lane(normal, i));
    expect_equal(one.push, lane(many.push, i));
    expect_equal(one.twist, lane(many.twist, i));
  }
}

}  // namespace
}  // namespace clca::boltzmann::solid_collision_test
