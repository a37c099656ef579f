#pragma once
// Order of grains, contacts and moves; depends on the direction of gravity.

#include <array>
#include <cstdint>

#include "clca/contact/state.hpp"

namespace clca::contact {

/// Weights of columns and doubled heights in coordinate_along().
struct Slope {
  int column = 0;
  int height = 0;
};
inline Slope slope(lattice::Direction direction) {
  const lattice::Axial step = unit(direction);
  return {3 * step.x, 2 * step.q + step.x};
}

/// Four times the coordinate of a site along a direction, as an integer; only for comparison.
inline int coordinate_along(lattice::Direction direction, lattice::Site site) {
  const Slope along = slope(direction);
  return along.column * site.column + along.height * lattice::doubled_height(site);
}

/// Sort key of a grain: from the top down, at equal height from the left.
std::int64_t order_key(const grains::State& state, lattice::Direction down, std::uint32_t id);

/// Whether a grain is the upper one of two.
inline bool is_above(const grains::State& state, lattice::Direction down, std::uint32_t one,
                     std::uint32_t other) {
  return order_key(state, down, one) < order_key(state, down, other);
}

/// Order of move directions in a step: down first, up last; a coin decides between two at the same
/// angle.
std::array<lattice::Direction, lattice::kDirectionCount> order_of_directions(
    const grains::State& state, lattice::Direction down);

}  // namespace clca::contact
