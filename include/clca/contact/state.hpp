#pragma once
// The state of the contact model: grains, their velocities and their contacts.

#include <cstdint>
#include <vector>

#include "clca/contact/vessel.hpp"
#include "clca/grains/state.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::contact {

/// Velocities and lengths are integers in units of 2^-23 lattice spacings (per step). With 2^-20,
/// rounding would let the forces of a bed at rest drift until a contact slides.
inline constexpr int kFractionBits = 23;
inline constexpr std::int32_t kSpacing = 1 << kFractionBits;  ///< a lattice spacing

// Bounds far above any useful run, so that no product overflows.
inline constexpr std::int32_t kMaxVelocity = 16 * kSpacing;  ///< velocities and spins
/// A step leaves at most 2 spacings along any direction.
inline constexpr std::int32_t kMaxRemainder = 8 * kSpacing;
inline constexpr std::int32_t kMaxImpulse = 1 << 29;  ///< in the unit of Impulse

/// Cartesian vector, in 2^-23 lattice spacings.
struct Vector {
  std::int32_t x = 0;
  std::int32_t y = 0;

  bool operator==(const Vector&) const = default;
  CLCA_FIELDS(x, y);
};

/// Velocity and spin of a grain, in 2^-23 lattice spacings per step.
template <class Int = std::int32_t>
struct Velocity {
  Int x = {};
  Int y = {};
  Int spin = {};  ///< angular velocity times radius, anticlockwise

  bool operator==(const Velocity&) const = default;
  CLCA_FIELDS(x, y, spin);
};

/// Bodies other than grains: walls (grains::wall_code) and the sides of the box.
inline constexpr grains::Owner kFloor = grains::kBorder;
inline constexpr grains::Owner kCeiling = grains::kBorder + 1;
inline constexpr grains::Owner kLeftSide = grains::kBorder + 2;
inline constexpr grains::Owner kRightSide = grains::kBorder + 3;

constexpr bool is_side(grains::Owner owner) {
  return owner <= kRightSide;  // walls and grains follow
}

inline constexpr int kUnitBits = 30;  ///< of components of unit vectors

/// Components in 2^-30.
struct UnitVector {
  std::int32_t x = 0;
  std::int32_t y = 0;

  bool operator==(const UnitVector&) const = default;
  CLCA_FIELDS(x, y);
};

/// Impulse on the upper body in a step, in 2^-23 lattice spacings per step times the unit of mass:
/// a site, or more if grains have more than 16 sites (see mass_unit()).
template <class Int = std::int32_t>
struct Impulse {
  Int normal = {};   ///< not negative
  Int shear = {};    ///< along the normal turned anticlockwise
  Int rolling = {};  ///< moment over the reduced radius

  bool operator==(const Impulse&) const = default;
  CLCA_FIELDS(normal, shear, rolling);
};

/// The unit of mass of impulses, in sites: 1 if no grain has more than 16 sites, else a power of
/// two, so that impulses of large grains stay in range.
double mass_unit(const std::vector<grains::Kind>& kinds);

/// A contact between a grain and another body.
struct Contact {
  std::uint32_t upper = 0;  ///< the higher of two grains; of two at one height the left one
  grains::Owner other = 0;
  UnitVector normal = {};  ///< towards the upper grain, in the last step
  Impulse<> impulse = {};  ///< of the last step; the next one begins with it
  /// Part of the impulse of the last step that is not carried over to the next: from an impact
  /// solved on its own, or from extra sweeps of a small group. The normal impulses of `impulse` and
  /// `transient` have a sum that is not negative.
  Impulse<> transient = {};

  bool operator==(const Contact&) const = default;
  CLCA_FIELDS(upper, other, normal, impulse, transient);
};

/// Contacts per grain, for estimates of memory; lists that double have room for 3, as in crystals.
inline constexpr double kContactsPerGrain = 2;

/// Steps in a row without motion after which a state counts as settled.
inline constexpr std::uint64_t kSettlingSteps = 60;

struct State {
  grains::State grains;
  std::vector<Velocity<>> velocities = {};  ///< by id
  std::vector<Vector> remainders = {};      ///< by id: where grains are, beyond their sites
  /// By id: vector from the anchor of a grain to its site. The anchor follows a grain that goes
  /// farther than to a neighbouring site.
  std::vector<lattice::Axial> from_anchors = {};
  /// By wall: its motion is ahead of it by this, in 2^-20 lattice spacings along its direction.
  std::vector<std::int64_t> wall_remainders = {};
  /// Contacts of the last step, in sweep order.
  std::vector<Contact> contacts = {};
  /// True if walls or grains were changed from outside: contacts are sorted anew.
  bool changed = true;
  std::uint64_t unmoved_steps = 0;  ///< in a row in which no wall and no anchor of a grain moved
  std::uint64_t quiet_steps = 0;    ///< in a row in which no site changed and all grains rested
  Vessel vessel = {};

  bool operator==(const State&) const = default;
  CLCA_FIELDS(grains, velocities, remainders, from_anchors, wall_remainders, contacts, changed,
              unmoved_steps, quiet_steps, vessel);
};

}  // namespace clca::contact
