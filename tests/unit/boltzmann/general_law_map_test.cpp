// The collision as a map of the twelve velocities of a pair, and what it does to volumes there.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "general_law.hpp"
#include "random_contacts.hpp"

namespace clca::boltzmann::general_law_map_test {
namespace {

using Vector12d = Eigen::Vector<double, 12>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

constexpr int kCases = 300;

Vector12d coordinates(const CollisionState& contact) {
  Vector12d result;
  result << contact.first.velocity, contact.first.spin, contact.second.velocity,
      contact.second.spin;
  return result;
}

CollisionState contact_at(const Vector12d& coordinates, const Eigen::Vector3d& normal) {
  return {.first = {.velocity = coordinates.segment<3>(0), .spin = coordinates.segment<3>(3)},
          .second = {.velocity = coordinates.segment<3>(6), .spin = coordinates.segment<3>(9)},
          .normal = normal};
}

/// Of the map at a fixed normal, from differences over `step` to both sides.
Matrix12d jacobian(const Case& one, double step) {
  Matrix12d result;
  for (int i = 0; i < 12; ++i) {
    const Vector12d change = step * Vector12d::Unit(i);
    const auto image = [&](const Vector12d& place) {
      return coordinates(collide(one.law, one.pair, contact_at(place, one.contact.normal)));
    };
    const Vector12d place = coordinates(one.contact);
    result.col(i) = (image(place + change) - image(place - change)) / (2 * step);
  }
  return result;
}

TEST(GeneralLawMap, ShrinksVolumesByTheRestitutionAndTheSquareOfAConstantRatio) {
  RandomContacts random(7);
  for (int i = 0; i < kCases; ++i) {
    Case one = random.any();
    one.law.friction = kNoSlidingLimit;
    one.contact.first.velocity += 2 * one.pair.first.radius * one.contact.normal;  // stays so
    const double ratio = -one.law.roughness;
    const double normal = one.contact.slip(one.pair).dot(one.contact.normal);
    // The map is linear, so that no step is too long.
    EXPECT_NEAR(std::abs(jacobian(one, normal / 4).determinant()),
                one.law.restitution * ratio * ratio, 1e-11);
  }
}

TEST(GeneralLawMap, ShrinksVolumesByTheRestitutionAndTheRatioWhereItSlides) {
  // Friction takes from the speed of sliding what does not depend on it, and leaves its direction.
  RandomContacts random(8);
  int sliding = 0;
  while (sliding < kCases) {
    Case one = random.any();
    one.law.roughness = 0;
    const double ratio = tangential_ratio(one.law, one.pair, one.contact);
    const bool far_from_sticking =
        ratio > 0.05 && tangential_slip(one.pair, one.contact).norm() > 1;
    const bool far_from_parting = one.contact.slip(one.pair).dot(one.contact.normal) > 0.1;
    if (far_from_sticking && far_from_parting) {
      ++sliding;
      EXPECT_NEAR(std::abs(jacobian(one, 1e-4).determinant()), one.law.restitution * ratio, 1e-6);
    }
  }
}

}  // namespace
}  // namespace clca::boltzmann::general_law_map_test
