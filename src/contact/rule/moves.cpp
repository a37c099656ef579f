#include "contact/rule/moves.hpp"

#include <algorithm>

#include "contact/rule/order.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

namespace {

using lattice::Direction;

class Mover {
 public:
  Mover(grains::State& state, std::span<Vector> remainders, grains::Occupancy& occupancy,
        const grains::FootprintTable& footprints)
      : state_(state), remainders_(remainders), occupancy_(occupancy), footprints_(footprints) {}

  /// All moves in one direction: a grain follows one that moves out of its way. The result does not
  /// depend on the order of the grains.
  void move(Direction direction, std::span<const std::uint32_t> ids,
            std::vector<std::uint32_t>& moved) {
    waiting_.clear();
    for (const std::uint32_t id : ids) {
      if (wants(remainders_[id], direction) && !try_move(id, direction, moved)) {
        waiting_.push_back(id);
      }
    }
    if (waiting_.empty()) {
      return;
    }
    // Those in front first: a whole row goes at once.
    std::sort(waiting_.begin(), waiting_.end(), [&](std::uint32_t one, std::uint32_t other) {
      return place_along(direction, state_.particles[one].site()) >
             place_along(direction, state_.particles[other].site());
    });
    const auto goes = [&](std::uint32_t id) { return try_move(id, direction, moved); };
    while (std::erase_if(waiting_, goes) > 0) {
    }
  }

 private:
  template <class Visit>
  void for_each_place(const grains::Particle& grain, const std::vector<lattice::Offset>& offsets,
                      Visit visit) const {
    const lattice::Lattice& lattice = state_.lattice;
    const std::size_t place = lattice.index(grain.site());
    const int column = lattice.wrapped(grain.column);
    for (const lattice::Offset offset : offsets) {
      visit(lattice.at(place, column, offset));
    }
  }

  bool try_move(std::uint32_t id, Direction direction, std::vector<std::uint32_t>& moved) {
    grains::Particle& grain = state_.particles[id];
    const grains::Footprint& footprint = footprints_.of(grain);
    const auto at = lattice::index_of(direction);
    bool free = true;
    for_each_place(grain, footprint.lead[at],
                   [&](std::size_t place) { free = free && !occupancy_.taken(place); });
    if (!free) {
      return false;
    }
    for_each_place(grain, footprint.trail[at],
                   [&](std::size_t place) { occupancy_.release(place); });
    for_each_place(grain, footprint.lead[at], [&](std::size_t place) {
      occupancy_.take(place, static_cast<grains::Owner>(id));
    });
    const lattice::Site target = grain.site() + unit(direction);
    grain.column = target.column;
    grain.row = target.row;
    grain.previous = static_cast<grains::Move>(direction);
    take(remainders_[id], kSpacing, direction);
    moved.push_back(id);
    return true;
  }

  grains::State& state_;
  std::span<Vector> remainders_;
  grains::Occupancy& occupancy_;
  const grains::FootprintTable& footprints_;
  std::vector<std::uint32_t> waiting_;
};

}  // namespace

void move_grains(grains::State& state, std::span<Vector> remainders, grains::Occupancy& occupancy,
                 const grains::FootprintTable& footprints, lattice::Direction down,
                 std::span<const std::uint32_t> ids, std::vector<std::uint32_t>& moved) {
  Mover mover(state, remainders, occupancy, footprints);
  for (const Direction direction : order_of_directions(state, down)) {
    mover.move(direction, ids, moved);
  }
}

}  // namespace clca::contact
