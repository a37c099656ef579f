#include "contact/rule/order.hpp"

#include <algorithm>
#include <utility>

#include "clca/random/draw.hpp"

namespace clca::contact {

using lattice::Direction;

std::int64_t order_key(const grains::State& state, Direction down, std::uint32_t id) {
  constexpr std::int64_t kColumns = std::int64_t{1} << 31;
  const grains::Particle& grain = state.particles[id];
  const int column = state.lattice.wrapped(grain.column);
  return coordinate_along(down, {column, grain.row}) * kColumns + column;
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
