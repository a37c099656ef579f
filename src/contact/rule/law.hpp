#pragma once
// The contact law: contact dynamics (Moreau 1994, Jean 1999), one contact at a time. `Int` is
// std::int32_t, or eight of them for eight contacts that share no grain.

#include <cstdint>
#include <functional>
#include <vector>

#include "clca/contact/contact_model.hpp"
#include "clca/contact/state.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// Coefficients of a contact between two kinds, or a kind and a wall. Masses in 2^-16 of their unit
/// (see mass_unit), inverse masses in 2^-26; inverse masses of a wall are 0.
template <class Int>
struct Coefficients {
  Int mass;        ///< reduced: impulse along the normal over the change of velocity it makes
  Int shear_mass;  ///< of the impulse along the tangent: 2/7 of the reduced mass
  Int upper_inverse_mass;
  Int other_inverse_mass;
  // Rolling impulses are moments divided by the reduced radius.
  Int upper_rolling_mass;  ///< rolling impulse over the upper spin, by 0.3 of the reduced mass
  Int other_rolling_mass;
  /// Half of the spin that a rolling impulse of 1 gives; at most 8, as inverse masses.
  Int upper_rolling_response;
  Int other_rolling_response;
};
/// The coefficients of a pair of kinds, or of a kind and a wall.
using PairCoefficients = Coefficients<std::int32_t>;

/// Constants of the law, the same for all contacts. Coefficients in 2^-16.
struct LawConstants {
  bool rotates = false;  ///< otherwise grains keep their orientation
  bool resists_rolling = false;
  std::int32_t rolling_friction = 0;
};

/// Velocities of the two bodies of a contact, normal and coefficients. A wall has inverse mass 0.
template <class Int = std::int32_t>
struct ContactBodies {
  Velocity<Int> upper;
  Velocity<Int> other;
  Int normal_x;  ///< towards the upper body, in 2^-30
  Int normal_y;
  Coefficients<Int> coefficients;
};

/// Normal velocity of the upper body relative to the other; positive if they separate.
template <class Int>
[[gnu::always_inline]] inline Int separation_velocity(const ContactBodies<Int>& both) {
  return rounded(product(both.upper.x - both.other.x, both.normal_x) +
                     product(both.upper.y - both.other.y, both.normal_y),
                 kUnitBits);
}

/// Tangential velocity at the contact, along the normal turned anticlockwise.
template <class Int>
[[gnu::always_inline]] inline Int slip_velocity(const ContactBodies<Int>& both) {
  return rounded(product(both.upper.y - both.other.y, both.normal_x) -
                     product(both.upper.x - both.other.x, both.normal_y),
                 kUnitBits) -
         both.upper.spin - both.other.spin;
}

/// Angular velocity of the upper body relative to the other, times the reduced radius.
inline std::int32_t rolling_velocity(const ContactBodies<>& both) {
  const auto part = [](std::int32_t spin, std::int32_t turning, std::int32_t inverse_mass) {
    return inverse_mass == 0 ? 0 : product(spin, turning) / inverse_mass;  // a wall does not turn
  };
  return static_cast<std::int32_t>(part(both.upper.spin, both.coefficients.upper_rolling_response,
                                        both.coefficients.upper_inverse_mass) -
                                   part(both.other.spin, both.coefficients.other_rolling_response,
                                        both.coefficients.other_inverse_mass));
}

/// Applies impulses to the velocities of both bodies.
template <class Int>
[[gnu::always_inline]] inline void apply_impulse(ContactBodies<Int>& both, const Impulse<Int>& by,
                                                 bool rotates) {
  const Int x =
      rounded(product(by.normal, both.normal_x) - product(by.shear, both.normal_y), kUnitBits);
  const Int y =
      rounded(product(by.normal, both.normal_y) + product(by.shear, both.normal_x), kUnitBits);
  const auto changed = [](Int now, const auto& change, int bits) __attribute__((always_inline)) {
    return clamped(now + limited(change, bits, 2 * kMaxVelocity), -kMaxVelocity, kMaxVelocity);
  };
  const auto pushed = [&](Int now, Int impulse, Int inverse_mass) __attribute__((always_inline)) {
    return changed(now, product(impulse, inverse_mass), kInverseMassBits);
  };
  both.upper.x = pushed(both.upper.x, x, both.coefficients.upper_inverse_mass);
  both.upper.y = pushed(both.upper.y, y, both.coefficients.upper_inverse_mass);
  both.other.x = pushed(both.other.x, -x, both.coefficients.other_inverse_mass);
  both.other.y = pushed(both.other.y, -y, both.coefficients.other_inverse_mass);
  if (rotates) {
    // A tangential force turns both bodies the same way, a moment in opposite ways. Discs: inertia
    // = mass radius^2 / 2.
    constexpr int kDoubledInverseMassBits = kInverseMassBits - 1;
    both.upper.spin = changed(both.upper.spin,
                              product(by.rolling, both.coefficients.upper_rolling_response) -
                                  product(by.shear, both.coefficients.upper_inverse_mass),
                              kDoubledInverseMassBits);
    both.other.spin = changed(both.other.spin,
                              product(-by.rolling, both.coefficients.other_rolling_response) -
                                  product(by.shear, both.coefficients.other_inverse_mass),
                              kDoubledInverseMassBits);
  }
}

/// Updates the impulses: the bodies separate with the velocity `bounce`, and slide and roll less,
/// within the limits of friction. `friction` in 2^-16. Symbols of docs/contact.md: P, T, Q are
/// normal, shear, rolling; M, Mt, Mr are mass, shear_mass, *_rolling_mass; b is `bounce`.
template <class Int>
[[gnu::always_inline]] inline void solve_contact(Impulse<Int>& impulse, ContactBodies<Int>& both,
                                                 Int bounce, Int friction,
                                                 const LawConstants& law) {
  const Impulse<Int> before = impulse;
  const auto change = [](const auto& stopped) {
    return limited(stopped, kMassBits, 2 * kMaxImpulse);
  };
  // `friction_limit`: coefficient x normal impulse, of sliding or of rolling.
  const auto bound = [](Int wanted, const auto& friction_limit) {
    const Int limit = clamped(limited(friction_limit, kRatioBits, kMaxImpulse), 0, kMaxImpulse);
    return clamped(wanted, -limit, limit);
  };
  impulse.normal = clamped(
      before.normal - change(product(separation_velocity(both) - bounce, both.coefficients.mass)),
      0, kMaxImpulse);
  impulse.shear =
      bound(before.shear - change(product(slip_velocity(both), both.coefficients.shear_mass)),
            product(impulse.normal, friction));
  if (law.resists_rolling) {
    impulse.rolling = bound(
        before.rolling - change(product(both.upper.spin, both.coefficients.upper_rolling_mass) -
                                product(both.other.spin, both.coefficients.other_rolling_mass)),
        product(impulse.normal, in_all_lanes(law.rolling_friction, Int())));
  }
  apply_impulse(both,
                Impulse<Int>{impulse.normal - before.normal, impulse.shear - before.shear,
                             impulse.rolling - before.rolling},
                law.rotates);
}

/// Velocity with which bodies separate after colliding with `closing`; 0 if that is no impact.
inline std::int32_t bounce_velocity(std::int32_t closing, std::int32_t restitution) {
  constexpr std::int32_t kMinClosingVelocity =
      kSpacing / 32;  // below it large beds would not come to rest
  return closing > kMinClosingVelocity ? rounded(product(closing, restitution), kRatioBits) : 0;
}

/// The coefficients by kind and other kind, of which the last is a wall.
std::vector<PairCoefficients> all_pair_coefficients(const std::vector<grains::Kind>& kinds);

/// Number in all_pair_coefficients() of the bodies of a contact.
inline std::int32_t pair_index(const grains::State& grains, std::uint32_t upper,
                               grains::Owner other) {
  const std::size_t kinds = grains.kinds.size();
  const auto kind = [&](std::size_t id) -> std::size_t { return grains.particles[id].kind; };
  return static_cast<std::int32_t>(
      kind(upper) * (kinds + 1) +
      (grains::is_particle(other) ? kind(grains::particle_id(other)) : kinds));
}

/// Constants of the rule, which may differ between stages. Ratios in 2^-16.
struct Rule {
  std::int32_t gravity = 0;  ///< in 2^-23 lattice spacings per step squared
  std::int32_t restitution = 0;
  int sweeps = 2;
  std::int32_t friction = 0;                     ///< between grains
  std::int32_t side_friction = 0;                ///< of the sides of the box
  std::vector<std::int32_t> wall_friction = {};  ///< by wall
  LawConstants law = {};
  std::vector<PairCoefficients> pair_coefficients = {};  ///< all_pair_coefficients()

  std::int32_t friction_with(grains::Owner other) const {
    if (grains::is_particle(other)) {
      return friction;
    }
    return is_side(other) ? side_friction : wall_friction[grains::wall_number(other)];
  }
  /// Speed up to which a grain counts as at rest: twice what gravity adds in a step.
  std::int32_t rest_speed_limit() const { return 2 * gravity; }
};

/// The parameters as whole numbers, and the coefficients of all pairs of kinds. Throws
/// std::invalid_argument if a parameter is out of range. `gravity` in lattice spacings per step
/// squared.
Rule make_rule(const grains::State& state, const Parameters& parameters, double gravity);

/// The velocities of all bodies, which contacts change.
struct BodyVelocities {
  const grains::State& grains;
  const Rule& rule;
  /// Velocity of a grain, wall or side. Only those of grains are changed.
  std::function<Velocity<>&(grains::Owner)> velocity;

  /// Calls `visit` with the present ContactBodies of a contact, whose velocities it may change.
  template <class Visit>
  void visit_contact(const Contact& contact, Visit visit) const {
    Velocity<>& upper = velocity(grains::as_owner(contact.upper));
    Velocity<>& other = velocity(contact.other);
    ContactBodies<> both = {.upper = upper,
                            .other = other,
                            .normal_x = contact.normal.x,
                            .normal_y = contact.normal.y,
                            .coefficients = rule.pair_coefficients[static_cast<std::size_t>(
                                pair_index(grains, contact.upper, contact.other))]};
    visit(both);
    upper = both.upper;
    other = both.other;
  }
};

}  // namespace clca::contact
