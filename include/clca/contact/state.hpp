#pragma once
// The state of a run of the contact model: the grains, how they move, and what passes between
// those that touch.

#include <cstdint>
#include <vector>

#include "clca/contact/vessel.hpp"
#include "clca/fields/fields.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::contact {

/// Velocities and lengths are whole numbers of 2^-23 lattice spacings (a step). With 2^-20 the
/// forces of a bed at rest drift by rounding until some contact slides.
inline constexpr int kFractionBits = 23;
inline constexpr std::int32_t kSpacing = 1 << kFractionBits;

// Bounds that no run of any use comes near, so that no product overflows.
inline constexpr std::int32_t kFastest = 16 * kSpacing;  ///< velocities and spins
inline constexpr std::int32_t kFarthest =
    8 * kSpacing;                                    ///< remainders: a step makes six moves at most
inline constexpr std::int32_t kStrongest = 1 << 29;  ///< impulses

/// Cartesian, in 2^-23 lattice spacings.
struct Vector {
  std::int32_t x = 0;
  std::int32_t y = 0;

  bool operator==(const Vector&) const = default;
  static constexpr auto fields() {
    return std::make_tuple(fields::field("x", &Vector::x), fields::field("y", &Vector::y));
  }
};

/// Of a grain, in 2^-23 lattice spacings a step.
template <class Int>
struct Velocity {
  Int x = {};
  Int y = {};
  Int spin = {};  ///< angular velocity times radius, anticlockwise

  bool operator==(const Velocity&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("x", &Velocity::x), field("y", &Velocity::y),
                           field("spin", &Velocity::spin));
  }
};

/// What else than a grain one may touch: a wall (grains::wall_code) or a side of the box.
inline constexpr grains::Owner kFloor = grains::kBorder;
inline constexpr grains::Owner kCeiling = grains::kBorder + 1;
inline constexpr grains::Owner kLeftSide = grains::kBorder + 2;
inline constexpr grains::Owner kRightSide = grains::kBorder + 3;

inline constexpr int kUnitBits = 30;  ///< of components of unit vectors

/// Components in 2^-30.
struct UnitVector {
  std::int32_t x = 0;
  std::int32_t y = 0;

  bool operator==(const UnitVector&) const = default;
  static constexpr auto fields() {
    return std::make_tuple(fields::field("x", &UnitVector::x), fields::field("y", &UnitVector::y));
  }
};

/// What a body gives the upper one in a step, in 2^-23 lattice spacings a step times the unit of
/// mass, which is a site, or more where there are grains of more than 16 sites (see forces()).
template <class Int>
struct Impulse {
  Int normal = {};   ///< not negative
  Int shear = {};    ///< along the normal turned anticlockwise
  Int rolling = {};  ///< moment over the reduced radius

  bool operator==(const Impulse&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("normal", &Impulse::normal), field("shear", &Impulse::shear),
                           field("rolling", &Impulse::rolling));
  }
};

/// A grain and what it touches.
struct Contact {
  std::uint32_t upper = 0;  ///< the higher of two grains; of two at one height the left one
  grains::Owner other = 0;
  UnitVector normal = {};  ///< towards the upper grain, in the last step
  Impulse<std::int32_t> impulse = {};

  bool operator==(const Contact&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("upper", &Contact::upper), field("other", &Contact::other),
                           field("normal", &Contact::normal), field("impulse", &Contact::impulse));
  }
};

/// Grains that steps leave out (rule/sleep.hpp). Nothing in it where none may sleep.
struct Sleep {
  static constexpr bool kHashedOnlyIfSet = true;

  /// By id: for how many checks in a row a grain has been at rest, at most kAsleep; or kDisturbed.
  std::vector<std::uint8_t> rests = {};
  std::vector<Contact> contacts = {};  ///< of sleepers with each other, with walls and sides

  bool operator==(const Sleep&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("rests", &Sleep::rests), field("contacts", &Sleep::contacts));
  }
};

struct State {
  grains::State grains;
  std::vector<Velocity<std::int32_t>> velocities = {};  ///< by id
  std::vector<Vector> remainders = {};  ///< by id: where grains are, beyond their sites
  /// By wall: how far its motion is ahead of it, in 2^-20 lattice spacings along its direction.
  std::vector<std::int64_t> wall_remainders = {};
  /// Of the last step, in the order in which they are swept; others are in `sleep`.
  std::vector<Contact> contacts = {};
  /// Something other than the step itself has changed walls or grains: contacts are put in order
  /// anew.
  bool changed = true;
  std::uint64_t quiet_steps = 0;  ///< in a row: without a move, and with hardly any velocity
  Vessel vessel = {};
  Sleep sleep = {};

  bool operator==(const State&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("grains", &State::grains), field("velocities", &State::velocities),
                           field("remainders", &State::remainders),
                           field("wall_remainders", &State::wall_remainders),
                           field("contacts", &State::contacts), field("changed", &State::changed),
                           field("quiet_steps", &State::quiet_steps),
                           field("vessel", &State::vessel), field("sleep", &State::sleep));
  }
};

}  // namespace clca::contact
