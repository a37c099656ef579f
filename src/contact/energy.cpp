#include "clca/contact/energy.hpp"

#include <algorithm>
#include <cmath>

#include "contact/energy_of.hpp"
#include "contact/internal/mass_unit.hpp"
#include "contact/rule/acceleration.hpp"

namespace clca::contact {

namespace {

Eigen::Vector2d in_spacings(std::int32_t x, std::int32_t y) {
  return std::ldexp(1, -kFractionBits) * Eigen::Vector2d(x, y);
}

Eigen::Vector2d in_spacings(const Vector& vector) {
  return in_spacings(vector.x, vector.y);
}

Eigen::Vector2d as_double(const UnitVector& unit) {
  return {std::ldexp(unit.x, -kUnitBits), std::ldexp(unit.y, -kUnitBits)};
}

double mass_of(const State& state, std::size_t id) {
  return static_cast<double>(state.grains.shape(state.grains.particles[id]).size());
}

/// Mass and, from its site, centre of a grain.
struct BodyOfKind {
  double mass = 0;
  Eigen::Vector2d centre;
};

BodyOfKind body_of(const grains::Kind& kind) {
  return {.mass = static_cast<double>(kind.shape.size()), .centre = kind.shape.centroid()};
}

Energy energy_of(const State& state, std::size_t id, const BodyOfKind& body,
                 const Eigen::Vector2d& down, double gravity) {
  const Velocity<std::int32_t>& velocity = state.velocities[id];
  const double spin = static_cast<double>(velocity.spin) / kSpacing;
  const Eigen::Vector2d place = lattice::position(state.grains.particles[id].site()) + body.centre +
                                in_spacings(state.remainders[id]);
  return {.kinetic = body.mass *
                     (in_spacings(velocity.x, velocity.y).squaredNorm() + spin * spin / 2) / 2 /
                     gravity,
          .potential = -body.mass * down.dot(place)};
}

/// Centre of mass.
Eigen::Vector2d place_of(const State& state, std::size_t id) {
  return grains::centre(state.grains, state.grains.particles[id]) +
         in_spacings(state.remainders[id]);
}

}  // namespace

Energy energy_of(const State& state, std::size_t id, double gravity) {
  return energy_of(state, id, body_of(state.grains.kinds[state.grains.particles[id].kind]),
                   gravity_direction(state.vessel), gravity);
}

Energy energy(const State& state, double gravity) {
  std::vector<BodyOfKind> kinds;
  for (const grains::Kind& kind : state.grains.kinds) {
    kinds.push_back(body_of(kind));
  }
  const Eigen::Vector2d down = gravity_direction(state.vessel);
  Energy sum;
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    if (const grains::Particle& grain = state.grains.particles[id]; grain.present) {
      const Energy one = energy_of(state, id, kinds[grain.kind], down, gravity);
      sum.kinetic += one.kinetic;
      sum.potential += one.potential;
    }
  }
  return sum;
}

std::vector<double> wall_positions(const State& state) {
  std::vector<double> result;
  for (std::size_t wall = 0; wall < state.wall_remainders.size(); ++wall) {
    const double ahead =
        static_cast<double>(state.wall_remainders[wall]) / static_cast<double>(grains::kSpacing);
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
          (contact.impulse.normal * normal + contact.impulse.shear * tangent) / kSpacing;
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
  const Vector still = acceleration(at_rest(before), integer_gravity, periodic).gravity;
  const Eigen::Vector2d shaking = in_spacings(by.gravity) - in_spacings(still);
  const double squared_rate = std::ldexp(static_cast<double>(by.squared_rate), -kCentrifugalBits);
  const Eigen::Vector2d centre =
      std::ldexp(1, -kCentreBits) * Eigen::Vector2d(by.centre_x, by.centre_y);
  const Eigen::Vector2d turn = gravity_direction(state.vessel) - gravity_direction(before);
  Eigen::Vector2d momentum = Eigen::Vector2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();  // mass times place
  double outwards = 0;                               // mass times velocity from the centre
  for (std::size_t id = 0; id < state.velocities.size(); ++id) {
    if (const grains::Particle& grain = state.grains.particles[id]; grain.present) {
      const Eigen::Vector2d impulse =
          mass_of(state, id) * in_spacings(state.velocities[id].x, state.velocities[id].y);
      momentum += impulse;
      moment += mass_of(state, id) * place_of(state, id);
      outwards += impulse.dot(lattice::position(grain.site()) - centre);
    }
  }
  return (shaking.dot(momentum) + squared_rate * outwards) / gravity - turn.dot(moment);
}

}  // namespace clca::contact
