#include "contact/rule/order.hpp"

#include <algorithm>
#include <utility>

#include "clca/random/draw.hpp"

namespace clca::contact {

using lattice::Direction;

bool is_above(const grains::State& state, Direction down, std::uint32_t one, std::uint32_t other) {
  const auto key = [&](std::uint32_t id) {
    const grains::Particle& grain = state.particles[id];
    const int column = state.lattice.wrapped(grain.column);
    return std::pair(place_along(down, {column, grain.row}), column);
  };
  return key(one) < key(other);
}

std::uint64_t order_key(const grains::State& state, Direction down, std::uint32_t id) {
  constexpr int kDepthBits = 31;
  constexpr int kStripBits = 24;
  const lattice::Lattice& lattice = state.lattice;
  const grains::Particle& grain = state.particles[id];
  const int wrapped = lattice.wrapped(grain.column);
  const Slope along = slope(down);
  const int highest = std::min(0, along.column * lattice.columns()) +
                      std::min(0, 2 * along.height * lattice.rows());
  const auto depth = static_cast<std::uint64_t>(place_along(down, {wrapped, grain.row}) - highest);
  const auto strip = static_cast<std::uint64_t>(strip_of(lattice, wrapped));
  const std::uint64_t strip_order = strip % 2 << (kStripBits - 1) | strip / 2;
  return (strip_order << kDepthBits | depth) * kStripColumns |
         static_cast<std::uint64_t>(wrapped % kStripColumns);
}

std::array<Direction, lattice::kDirectionCount> order_of_directions(const grains::State& state,
                                                                    Direction down) {
  const std::uint64_t coins =
      random::draw(state.seed, state.step, 0, random::Purpose::direction_order);
  const auto turned = [down](int sixths) { return lattice::rotated(down, sixths); };
  std::array<Direction, lattice::kDirectionCount> order = {down,       turned(-1), turned(1),
                                                           turned(-2), turned(2),  turned(3)};
  if ((coins & 1U) != 0) {
    std::swap(order[1], order[2]);
  }
  if ((coins & 2U) != 0) {
    std::swap(order[3], order[4]);
  }
  return order;
}

}  // namespace clca::contact
