#pragma once
// The state of a run of the contact model: the grains, how they move, and what passes between
// those that touch.

#include <cstdint>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::contact {

/// Velocities and lengths are whole numbers of 2^-20 lattice spacings (a step).
inline constexpr int kFractionBits = 20;
inline constexpr std::int32_t kSpacing = 1 << kFractionBits;

/// Cartesian, in 2^-20 lattice spacings (a step).
struct Vector {
  std::int32_t x = 0;
  std::int32_t y = 0;

  bool operator==(const Vector&) const = default;
  static constexpr auto fields() {
    return std::make_tuple(fields::field("x", &Vector::x), fields::field("y", &Vector::y));
  }
};

/// Of one grain.
struct Motion {
  Vector velocity;
  Vector remainder;       ///< of its place, beyond its site
  std::int32_t spin = 0;  ///< angular velocity times radius, anticlockwise: a velocity

  bool operator==(const Motion&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("velocity", &Motion::velocity),
                           field("remainder", &Motion::remainder), field("spin", &Motion::spin));
  }
};

/// What else than a grain one may touch: a wall (grains::wall_code) or a side of the box.
inline constexpr grains::Owner kFloor = grains::kBorder;
inline constexpr grains::Owner kCeiling = grains::kBorder + 1;
inline constexpr grains::Owner kLeftSide = grains::kBorder + 2;
inline constexpr grains::Owner kRightSide = grains::kBorder + 3;

/// A grain and what it touches. Impulses in a step, of the lower body on the upper one: sites times
/// 2^-20 lattice spacings a step, where a site is the unit of mass.
struct Contact {
  std::uint32_t upper = 0;  ///< the higher of two grains; of two at one height the left one
  grains::Owner other = 0;
  std::int32_t normal = 0;   ///< not negative
  std::int32_t shear = 0;    ///< along the normal turned anticlockwise
  std::int32_t rolling = 0;  ///< moment over the reduced radius

  bool operator==(const Contact&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("upper", &Contact::upper), field("other", &Contact::other),
                           field("normal", &Contact::normal), field("shear", &Contact::shear),
                           field("rolling", &Contact::rolling));
  }
};

struct State {
  grains::State grains;
  std::vector<Motion> motions = {};  ///< by id
  /// Of the last step, in the order in which they are swept.
  std::vector<Contact> contacts = {};
  /// Something other than the step itself has changed walls or grains: contacts are put in order
  /// anew.
  bool changed = true;
  std::uint64_t quiet_steps = 0;  ///< in a row: without a move, and with hardly any velocity

  bool operator==(const State&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("grains", &State::grains), field("motions", &State::motions),
                           field("contacts", &State::contacts), field("changed", &State::changed),
                           field("quiet_steps", &State::quiet_steps));
  }
};

}  // namespace clca::contact
