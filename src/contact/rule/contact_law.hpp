#pragma once
// What passes between two bodies that touch: contact dynamics (Moreau 1994, Jean 1999), one contact
// at a time.

#include "clca/contact/state.hpp"
#include "contact/rule/bodies.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// What of the parameters the law needs. Coefficients in 2^-16.
struct Turning {
  bool turns = false;  ///< otherwise grains keep their orientation
  bool resists_rolling = false;
  std::int32_t rolling_friction = 0;
};

/// The bodies of a contact. A wall is a body at rest whose inverse mass is 0.
struct Touching {
  Motion& upper;
  Motion& other;
  UnitVector normal;  ///< towards the upper one
  const Pair& pair;
};

/// Changes the velocities of both bodies by impulses of a contact (see Contact).
inline void apply(const Touching& bodies, std::int32_t normal, std::int32_t shear,
                  std::int32_t rolling, bool turns) {
  const Vector impulse = normal * bodies.normal + shear * bodies.normal.turned();
  const auto push = [](Motion& motion, const Vector& by, std::int32_t inverse_mass) {
    motion.velocity =
        motion.velocity + Vector{narrow(scaled(std::int64_t{by.x} * inverse_mass, kUnitBits)),
                                 narrow(scaled(std::int64_t{by.y} * inverse_mass, kUnitBits))};
  };
  push(bodies.upper, impulse, bodies.pair.upper_inverse_mass);
  push(bodies.other, Vector() - impulse, bodies.pair.other_inverse_mass);
  if (turns) {
    // Both turn the same way by a force along the rim, in opposite ways by a moment.
    const auto turn = [&](Motion& motion, std::int32_t inverse_mass, std::int64_t moment) {
      motion.spin = narrow(motion.spin -
                           scaled(2 * std::int64_t{shear} * inverse_mass - moment, kUnitBits));
    };
    const Pair& pair = bodies.pair;
    turn(bodies.upper, pair.upper_inverse_mass, std::int64_t{rolling} * pair.upper_turning);
    turn(bodies.other, pair.other_inverse_mass, -std::int64_t{rolling} * pair.other_turning);
  }
}

/// Velocity of the upper body away from the other one, along the normal.
inline std::int32_t separation_velocity(const Touching& bodies) {
  return along(bodies.upper.velocity - bodies.other.velocity, bodies.normal);
}

/// The velocity with which bodies part that come together with the velocity `closing`.
inline std::int32_t bounce(std::int32_t closing, std::int32_t restitution) {
  constexpr std::int32_t kLeast = kSpacing / 32;  // below it large beds would not come to rest
  return closing > kLeast ? narrow(scaled(std::int64_t{closing} * restitution, kRatioBits)) : 0;
}

/// Changes the impulses of a contact so that its bodies part with the velocity `bounce` along the
/// normal and neither slide nor roll, as far as friction allows. `friction` in 2^-16.
inline void solve(Contact& contact, const Touching& bodies, std::int32_t bounce,
                  std::int32_t friction, const Turning& turning) {
  const Pair& pair = bodies.pair;
  const Vector velocity = bodies.upper.velocity - bodies.other.velocity;

  const std::int64_t separation = std::int64_t{along(velocity, bodies.normal)} - bounce;
  const std::int32_t normal =
      narrow(std::max<std::int64_t>(0, contact.normal - scaled(separation * pair.mass, kMassBits)));

  const std::int64_t slip = std::int64_t{along(velocity, bodies.normal.turned())} -
                            bodies.upper.spin - bodies.other.spin;
  const std::int64_t most_shear = scaled(std::int64_t{normal} * friction, kRatioBits);
  const std::int32_t shear =
      narrow(std::clamp(contact.shear - scaled(slip * pair.shear_mass, kMassBits), -most_shear,
                        most_shear));

  std::int32_t rolling = 0;
  if (turning.resists_rolling) {
    const std::int64_t stopped = std::int64_t{bodies.upper.spin} * pair.upper_rolling_mass -
                                 std::int64_t{bodies.other.spin} * pair.other_rolling_mass;
    const std::int64_t most = scaled(std::int64_t{normal} * turning.rolling_friction, kRatioBits);
    rolling = narrow(std::clamp(contact.rolling - scaled(stopped, kMassBits), -most, most));
  }

  apply(bodies, normal - contact.normal, narrow(std::int64_t{shear} - contact.shear),
        narrow(std::int64_t{rolling} - contact.rolling), turning.turns);
  contact.normal = normal;
  contact.shear = shear;
  contact.rolling = rolling;
}

}  // namespace clca::contact
