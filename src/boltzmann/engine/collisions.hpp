#pragma once
// Collisions computed together, one per SIMD lane.

#include <Eigen/Core>

#include "boltzmann/rule/colliding_pair.hpp"

namespace clca::boltzmann {

/// Lanes are rows, so that each component is contiguous. Width 1 is one collision with the same
/// arithmetic.
template <int kWidth>
struct Collisions {
  using Lanes = Eigen::Array<double, kWidth, 1>;
  using Motions = Eigen::Array<double, kWidth, 6>;

  Motions first;  // velocity and spin
  Motions second;
  Lanes first_speed;
  Lanes second_speed;
  Lanes height;  // of the line of centres, see there
  Lanes turn;

  /// Replaces the motions by those after the collisions, and sets the speeds.
  void compute(const Law& law) {
    CollidingPair<Lanes> pair = {.velocity1 = vector3(first, 0),
                                 .velocity2 = vector3(second, 0),
                                 .spin1 = vector3(first, 3),
                                 .spin2 = vector3(second, 3),
                                 .height = height,
                                 .turn = turn};
    collide(law, pair);
    first << pair.velocity1.x, pair.velocity1.y, pair.velocity1.z, pair.spin1.x, pair.spin1.y,
        pair.spin1.z;
    second << pair.velocity2.x, pair.velocity2.y, pair.velocity2.z, pair.spin2.x, pair.spin2.y,
        pair.spin2.z;
    first_speed = dot(pair.velocity1, pair.velocity1).sqrt();
    second_speed = dot(pair.velocity2, pair.velocity2).sqrt();
  }

 private:
  static Vector3<Lanes> vector3(const Motions& motions, int column) {
    return {motions.col(column), motions.col(column + 1), motions.col(column + 2)};
  }
};

}  // namespace clca::boltzmann
