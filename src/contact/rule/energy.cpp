// Energy of grains, and the work of walls and of the vessel in a step.

#include <algorithm>
#include <cmath>

#include "contact/rule/step.hpp"

namespace clca::contact {

namespace {

Eigen::Vector2d in_spacings(std::int32_t x, std::int32_t y) {
  return std::ldexp(1, -kFractionBits) * Eigen::Vector2d(x, y);
}

Eigen::Vector2d in_spacings(const Vector& vector) {
  return in_spacings(vector.x, vector.y);
}

double mass_of(const State& state, std::size_t id) {
  return static_cast<double>(state.grains.shape(state.grains.particles[id]).size());
}

/// Centre of mass in lattice spacings, with the remainder.
Eigen::Vector2d position_of(const State& state, std::size_t id) {
  return grains::centre(state.grains, state.grains.particles[id]) +
         in_spacings(state.remainders[id]);
}

}  // namespace

Energy grain_energy(const State& state, std::size_t id, double gravity) {
  const Velocity<>& velocity = state.velocities[id];
  const double mass = mass_of(state, id);
  const double spin = static_cast<double>(velocity.spin) / kSpacing;
  return {.kinetic = mass * (in_spacings(velocity.x, velocity.y).squaredNorm() + spin * spin / 2) /
                     2 / gravity,
          .potential = -mass * gravity_direction(state.vessel).dot(position_of(state, id))};
}

std::vector<double> wall_positions(const State& state) {
  std::vector<double> result;
  for (std::size_t wall = 0; wall < state.wall_remainders.size(); ++wall) {
    const double ahead = static_cast<double>(state.wall_remainders[wall]) /
                         static_cast<double>(grains::kMotionUnitsPerSpacing);
    result.push_back(state.grains.walls[wall].travel.offset + std::clamp(ahead, -1.0, 1.0));
  }
  return result;
}

double wall_work(const State& state, std::span<const Contact> contacts,
                 const std::vector<double>& before, double gravity) {
  const std::vector<double> now = wall_positions(state);
  double sum = 0;
  for (const Contact& contact : contacts) {
    if (grains::is_particle(contact.other) || is_side(contact.other)) {
      continue;
    }
    const std::size_t wall = grains::wall_number(contact.other);
    if (const auto& motion = state.grains.walls[wall].motion) {
      const Eigen::Vector2d normal = as_double(contact.normal);
      const Eigen::Vector2d tangent(-normal.y(), normal.x());
      const Eigen::Vector2d impulse =
          ((contact.impulse.normal + contact.transient.normal) * normal +
           (contact.impulse.shear + contact.transient.shear) * tangent) /
          kSpacing;
      sum += (now[wall] - before[wall]) *
             impulse.dot(lattice::position(lattice::unit(motion->direction)));
    }
  }
  return sum * mass_unit(state.grains.kinds) / gravity;
}

double vessel_work(const State& state, const Vessel& before, double gravity) {
  const bool periodic = state.grains.lattice.periodic();
  const auto integer_gravity = static_cast<std::int32_t>(gravity * kSpacing);
  const Acceleration by = acceleration(before, integer_gravity, periodic);
  const Vector still = acceleration(without_motion(before), integer_gravity, periodic).gravity;
  const Eigen::Vector2d shaking = in_spacings(by.gravity) - in_spacings(still);
  const double squared_angular_velocity =
      std::ldexp(static_cast<double>(by.squared_angular_velocity), -kSquaredRateBits);
  const Eigen::Vector2d centre =
      std::ldexp(1, -kCentreBits) * Eigen::Vector2d(by.centre_x, by.centre_y);
  const Eigen::Vector2d turn = gravity_direction(state.vessel) - gravity_direction(before);
  Eigen::Vector2d momentum = Eigen::Vector2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  // mass times position
  double outwards = 0;                               // mass times velocity from the centre
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    if (const grains::Particle& grain = state.grains.particles[id]; grain.present) {
      const Eigen::Vector2d impulse =
          mass_of(state, id) * in_spacings(state.velocities[id].x, state.velocities[id].y);
      momentum += impulse;
      moment += mass_of(state, id) * position_of(state, id);
      outwards += impulse.dot(lattice::position(grain.site()) - centre);
    }
  }
  return (shaking.dot(momentum) + squared_angular_velocity * outwards) / gravity - turn.dot(moment);
}

}  // namespace clca::contact
