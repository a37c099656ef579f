#pragma once
// The constants of a run, as integers.

#include <cstdint>
#include <functional>
#include <vector>

#include "clca/contact/parameters.hpp"
#include "clca/contact/state.hpp"
#include "contact/rule/bodies.hpp"
#include "contact/rule/contact_law.hpp"

namespace clca::contact {

/// Ratios in 2^-16.
struct Rule {
  std::int32_t gravity = 0;  ///< in 2^-23 lattice spacings per step squared
  std::int32_t restitution = 0;
  int sweeps = 2;
  std::int32_t friction = 0;                     ///< between grains
  std::int32_t side_friction = 0;                ///< of the sides of the box
  std::vector<std::int32_t> wall_friction = {};  ///< by wall
  LawConstants law = {};
  Bodies bodies;

  std::int32_t friction_with(grains::Owner other) const {
    if (grains::is_particle(other)) {
      return friction;
    }
    return is_side(other) ? side_friction : wall_friction[grains::wall_number(other)];
  }
};

/// Velocity of a grain, wall or side. Only those of grains are changed.
using VelocityOf = std::function<Velocity<std::int32_t>&(grains::Owner)>;

/// Calls `visit` with a contact as it is now, whose velocities it may change.
template <class Visit>
void at_contact(const Contact& contact, const grains::State& grains, const Rule& rule,
                const VelocityOf& velocity_of, Visit visit) {
  Velocity<std::int32_t>& upper = velocity_of(grains::as_owner(contact.upper));
  Velocity<std::int32_t>& other = velocity_of(contact.other);
  ContactState<std::int32_t> touching = {
      .upper = upper,
      .other = other,
      .normal_x = contact.normal.x,
      .normal_y = contact.normal.y,
      .pair = rule.bodies.pairs()[static_cast<std::size_t>(
          rule.bodies.pair_number(grains, contact.upper, contact.other))]};
  visit(touching);
  upper = touching.upper;
  other = touching.other;
}

/// Throws std::invalid_argument if a parameter is out of range. `gravity` in lattice spacings per
/// step squared.
Rule make_rule(const grains::State& state, const Parameters& parameters, double gravity);

/// Speed below which a grain counts as resting: twice what gravity gives in a step.
inline std::int32_t slow_speed(const Rule& rule) {
  return 2 * rule.gravity;
}

}  // namespace clca::contact
