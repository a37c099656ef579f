#pragma once
// Mass, inertia and contact normals of grains by kind.

#include <cstdint>
#include <optional>
#include <vector>

#include "clca/contact/parameters.hpp"
#include "clca/grains/state.hpp"
#include "contact/internal/mass_unit.hpp"
#include "contact/rule/numbers.hpp"

namespace clca::contact {

/// Coefficients of a contact between two kinds, or a kind and a wall. Masses in 2^-16 of their unit
/// (see mass_unit), inverse masses in 2^-26; inverse masses of a wall are 0.
template <class Int>
struct Coefficients {
  Int mass;        ///< reduced: of a change of relative velocity along the normal
  Int shear_mass;  ///< the same across it
  Int upper_inverse_mass;
  Int other_inverse_mass;
  // For moments divided by the reduced radius: the mass that stops a spin, and the change of spins.
  Int upper_rolling_mass;
  Int other_rolling_mass;
  Int upper_turning;  ///< half of it: a single site at a wall would need 2
  Int other_turning;
};
using Pair = Coefficients<std::int32_t>;

class Bodies {
 public:
  explicit Bodies(const std::vector<grains::Kind>& kinds);

  /// `other` is none for a wall.
  const Pair& pair(std::uint16_t kind, std::optional<std::uint16_t> other) const {
    return pairs_[number(kind, other)];
  }
  /// Of a contact between a grain and another body: its number in pairs().
  std::int32_t pair_number(const grains::State& grains, std::uint32_t upper,
                           grains::Owner other) const {
    const auto kind = [&](std::size_t id) { return grains.particles[id].kind; };
    return static_cast<std::int32_t>(grains::is_particle(other)
                                         ? number(kind(upper), kind(grains::particle_id(other)))
                                         : number(kind(upper), std::nullopt));
  }
  const std::vector<Pair>& pairs() const { return pairs_; }

 private:
  std::size_t number(std::uint16_t kind, std::optional<std::uint16_t> other) const {
    return kind * (kinds_ + 1) + (other ? *other : kinds_);
  }

  std::size_t kinds_;
  // By kind and other kind; the last other kind is a wall.
  std::vector<Pair> pairs_;
};

/// Contact normal of two grains, towards the first, with the second at `apart`; none if they do not
/// touch.
/// Two hexagons or discs: the line of centres. Otherwise opposite to the sum of the directions in
/// which the second blocks the first.
std::optional<UnitVector> normal_between(const lattice::Shape& first, const lattice::Shape& second,
                                         lattice::Axial apart);

}  // namespace clca::contact
