#pragma once
// Any law, any two spheres, any motion in which they approach.

#include <Eigen/Geometry>
#include <cstdint>
#include <random>

#include "general_law.hpp"

namespace clca::boltzmann {

struct Case {
  Law law;
  Pair pair;
  CollisionState contact;
};

class RandomContacts {
 public:
  explicit RandomContacts(std::uint64_t seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Eigen::Vector3d vector() {
    std::normal_distribution<double> normal;
    const double x = normal(generator_);
    const double y = normal(generator_);
    return {x, y, normal(generator_)};
  }
  /// From hollow to all mass at the centre.
  Sphere sphere() {
    const double radius = uniform(0.3, 3);
    const double mass = uniform(0.2, 5);
    return {
        .radius = radius, .mass = mass, .inertia = uniform(0.05, 2.0 / 3) * mass * radius * radius};
  }
  CollisionState approaching(const Pair& pair) {
    CollisionState contact = {.first = {.velocity = vector(), .spin = vector()},
                              .second = {.velocity = vector(), .spin = vector()},
                              .normal = vector().normalized()};
    if (contact.slip(pair).dot(contact.normal) < 0) {
      contact.normal = -contact.normal;
    }
    return contact;
  }
  /// Slides, sticks or rebounds.
  Case any() {
    const Law law = {.restitution = uniform(0, 1),
                     .friction = uniform(0, 1),
                     .roughness = uniform(0, 1) < 0.5 ? 0 : uniform(-1, 1)};
    const Pair pair = {.first = sphere(), .second = sphere()};
    return {.law = law, .pair = pair, .contact = approaching(pair)};
  }

 private:
  std::mt19937_64 generator_;
};

/// V_t, of the points that touch.
inline Eigen::Vector3d tangential_slip(const Pair& pair, const CollisionState& contact) {
  const Eigen::Vector3d slip = contact.slip(pair);
  return slip - slip.dot(contact.normal) * contact.normal;
}

}  // namespace clca::boltzmann
