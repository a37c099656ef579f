#pragma once
// The contact law: contact dynamics (Moreau 1994, Jean 1999), one contact at a time. `Int` is
// std::int32_t, or eight of them for eight contacts that share no grain.

#include "clca/contact/state.hpp"
#include "contact/rule/bodies.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// Constants of the law, the same for all contacts. Coefficients in 2^-16.
struct LawConstants {
  bool turns = false;  ///< otherwise grains keep their orientation
  bool resists_rolling = false;
  std::int32_t rolling_friction = 0;
};

/// Velocities of the two bodies of a contact, normal and coefficients. A wall has inverse mass 0,
/// so its velocity does not change.
template <class Int>
struct ContactState {
  Velocity<Int> upper;
  Velocity<Int> other;
  Int normal_x;  ///< towards the upper body, in 2^-30
  Int normal_y;
  Coefficients<Int> pair;
};

/// Normal velocity of the upper body relative to the other; positive if they separate.
template <class Int>
[[gnu::always_inline]] inline Int separation_velocity(const ContactState<Int>& at) {
  return rounded(
      product(at.upper.x - at.other.x, at.normal_x) + product(at.upper.y - at.other.y, at.normal_y),
      kUnitBits);
}

/// Tangential velocity at the contact, along the normal turned anticlockwise.
template <class Int>
[[gnu::always_inline]] inline Int slip_velocity(const ContactState<Int>& at) {
  return rounded(product(at.upper.y - at.other.y, at.normal_x) -
                     product(at.upper.x - at.other.x, at.normal_y),
                 kUnitBits) -
         at.upper.spin - at.other.spin;
}

/// Angular velocity of the upper body relative to the other, times the reduced radius.
inline std::int32_t rolling_velocity(const ContactState<std::int32_t>& at) {
  const auto part = [](std::int32_t spin, std::int32_t turning, std::int32_t inverse_mass) {
    return inverse_mass == 0 ? 0 : product(spin, turning) / inverse_mass;  // a wall does not turn
  };
  return static_cast<std::int32_t>(
      part(at.upper.spin, at.pair.upper_turning, at.pair.upper_inverse_mass) -
      part(at.other.spin, at.pair.other_turning, at.pair.other_inverse_mass));
}

/// Applies impulses to the velocities of both bodies.
template <class Int>
[[gnu::always_inline]] inline void apply(ContactState<Int>& at, const Impulse<Int>& by,
                                         bool turns) {
  const Int x =
      rounded(product(by.normal, at.normal_x) - product(by.shear, at.normal_y), kUnitBits);
  const Int y =
      rounded(product(by.normal, at.normal_y) + product(by.shear, at.normal_x), kUnitBits);
  const auto changed = [](Int velocity, const auto& change, int bits) {
    return clamped(velocity + limited(change, bits, 2 * kMaxVelocity), -kMaxVelocity, kMaxVelocity);
  };
  const auto pushed = [&](Int velocity, Int impulse, Int inverse_mass) {
    return changed(velocity, product(impulse, inverse_mass), kInverseMassBits);
  };
  at.upper.x = pushed(at.upper.x, x, at.pair.upper_inverse_mass);
  at.upper.y = pushed(at.upper.y, y, at.pair.upper_inverse_mass);
  at.other.x = pushed(at.other.x, -x, at.pair.other_inverse_mass);
  at.other.y = pushed(at.other.y, -y, at.pair.other_inverse_mass);
  if (turns) {
    // A tangential force turns both bodies the same way, a moment in opposite ways. Discs: inertia
    // = mass radius^2 / 2.
    constexpr int kHalvedMassBits = kInverseMassBits - 1;
    at.upper.spin = changed(
        at.upper.spin,
        product(by.rolling, at.pair.upper_turning) - product(by.shear, at.pair.upper_inverse_mass),
        kHalvedMassBits);
    at.other.spin = changed(
        at.other.spin,
        product(-by.rolling, at.pair.other_turning) - product(by.shear, at.pair.other_inverse_mass),
        kHalvedMassBits);
  }
}

/// Updates the impulses so that the bodies separate with the velocity `bounce` and neither slide
/// nor roll, within the limits of friction. `friction` in 2^-16.
template <class Int>
[[gnu::always_inline]] inline void solve(Impulse<Int>& impulse, ContactState<Int>& at, Int bounce,
                                         Int friction, const LawConstants& law) {
  const Impulse<Int> before = impulse;
  const auto change = [](const auto& stopped) {
    return limited(stopped, kMassBits, 2 * kMaxImpulse);
  };
  const auto bound = [](Int wanted, const auto& friction_force) {
    const Int limit = clamped(limited(friction_force, kRatioBits, kMaxImpulse), 0, kMaxImpulse);
    return clamped(wanted, -limit, limit);
  };
  impulse.normal =
      clamped(before.normal - change(product(separation_velocity(at) - bounce, at.pair.mass)), 0,
              kMaxImpulse);
  impulse.shear = bound(before.shear - change(product(slip_velocity(at), at.pair.shear_mass)),
                        product(impulse.normal, friction));
  if (law.resists_rolling) {
    impulse.rolling =
        bound(before.rolling - change(product(at.upper.spin, at.pair.upper_rolling_mass) -
                                      product(at.other.spin, at.pair.other_rolling_mass)),
              product(impulse.normal, all(law.rolling_friction, Int())));
  }
  apply(at,
        Impulse<Int>{impulse.normal - before.normal, impulse.shear - before.shear,
                     impulse.rolling - before.rolling},
        law.turns);
}

/// Separation velocity after a collision with the velocity `closing`; 0 if that is so small that it
/// is no impact.
inline std::int32_t bounce(std::int32_t closing, std::int32_t restitution) {
  constexpr std::int32_t kMinClosingVelocity =
      kSpacing / 32;  // below it large beds would not come to rest
  return closing > kMinClosingVelocity ? rounded(product(closing, restitution), kRatioBits) : 0;
}

}  // namespace clca::contact
