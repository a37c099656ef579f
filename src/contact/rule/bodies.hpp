#pragma once
// What of the shape of grains counts for their motion.

#include <cstdint>
#include <optional>
#include <vector>

#include "clca/contact/parameters.hpp"
#include "clca/grains/state.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// Coefficients of two kinds that touch, or of a kind and a wall. Masses in 2^-16 of their unit
/// (see mass_unit), what is divided by a mass in 2^-26; all of a wall is 0.
template <class Int>
struct Coefficients {
  Int mass;        ///< reduced: of a change of relative velocity along the normal
  Int shear_mass;  ///< the same across it
  Int upper_inverse_mass;
  Int other_inverse_mass;
  // Of a moment over the reduced radius: what it is for a spin that it stops, and how it changes
  // spins.
  Int upper_rolling_mass;
  Int other_rolling_mass;
  Int upper_turning;  ///< half of it: a single site at a wall would need 2
  Int other_turning;
};
using Pair = Coefficients<std::int32_t>;

/// Unit of mass in sites: 1 where no grain has more than 16, else a power of two, so that impulses
/// of large grains are no larger numbers than those of small ones.
double mass_unit(const std::vector<grains::Kind>& kinds);

class Bodies {
 public:
  Bodies(const std::vector<grains::Kind>& kinds, Rolling rolling);

  /// Which grain of a pair counts as a body of infinite mass.
  enum class Fixed : std::uint8_t { none, upper, other };

  /// No second kind: a wall.
  const Pair& pair(std::uint16_t kind, std::optional<std::uint16_t> other,
                   Fixed fixed = Fixed::none) const {
    const std::size_t among = static_cast<std::size_t>(fixed) * kinds_ + kind;
    return pairs_[among * (kinds_ + 1) + (other ? *other : kinds_)];
  }
  /// Of a kind, in 2^-16 of the unit.
  std::int32_t mass(std::uint16_t kind) const { return masses_[kind]; }

 private:
  std::size_t kinds_;
  // By `Fixed`, then by kind, then by the other kind, the last of them walls.
  std::vector<Pair> pairs_;
  std::vector<std::int32_t> masses_;  // by kind
};

/// Whether it is one, with its reference site in the middle.
bool is_hexagon(const lattice::Shape& shape);

/// The normal between two grains that touch, towards the first, when the second lies `apart` from
/// it; none where they do not touch. Of two hexagons it is the line of their centres; otherwise it
/// is opposite to the sum of the directions in which the first cannot move for the second.
std::optional<UnitVector> normal_between(const lattice::Shape& first, const lattice::Shape& second,
                                         lattice::Axial apart);

}  // namespace clca::contact
