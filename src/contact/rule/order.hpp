#pragma once
// What comes first, of grains, of contacts and of moves: it turns with gravity.

#include <array>
#include <cstdint>

#include "clca/contact/state.hpp"

namespace clca::contact {

/// How place_along() counts columns and doubled heights.
struct Slope {
  int column = 0;
  int height = 0;
};
inline Slope slope(lattice::Direction direction) {
  const lattice::Axial step = unit(direction);
  return {3 * step.x, 2 * step.q + step.x};
}

/// Twice the place of a site along a direction, in whole numbers; only to be compared.
inline int place_along(lattice::Direction direction, lattice::Site site) {
  const Slope along = slope(direction);
  return along.column * site.column + along.height * lattice::doubled_height(site);
}

/// Whether a grain is the upper one of two; of two at one height it is the left one.
bool is_above(const grains::State& state, lattice::Direction down, std::uint32_t one,
              std::uint32_t other);

/// Strips of columns, numbered from the left, in which contacts are put in order.
inline constexpr int kStripColumns = 128;
inline int strip_of(const lattice::Lattice& lattice, int column) {
  return lattice.wrapped(column) / kStripColumns;
}

/// The place of a grain among the upper ones of contacts, when these are put in order: by strips,
/// every second one first, in a strip from the top down, from the left.
std::uint64_t order_key(const grains::State& state, lattice::Direction down, std::uint32_t id);

/// Of moves in a step: down first, up last; of a pair at the same angle the one that a coin names.
std::array<lattice::Direction, lattice::kDirectionCount> order_of_directions(
    const grains::State& state, lattice::Direction down);

}  // namespace clca::contact
