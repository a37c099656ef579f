#include "contact/rule/moves.hpp"

#include <algorithm>

#include "contact/rule/order.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

namespace {

using lattice::Direction;

class Mover {
 public:
  Mover(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
        const grains::WallEdges& edges, std::span<const std::uint32_t> ids,
        std::span<WallMove> walls)
      : state_(state.grains),
        remainders_(state.remainders),
        occupancy_(occupancy),
        footprints_(footprints),
        edges_(edges),
        ids_(ids),
        walls_(walls) {}

  /// All moves in one direction: a grain follows one that moves out of its way. The result does not
  /// depend on the order of the grains.
  void move(Direction direction) {
    waiting_.clear();
    for (const std::uint32_t id : ids_) {
      if (wants(remainders_[id], direction) && !try_move(id, direction)) {
        waiting_.push_back(id);
      }
    }
    // Those in front first: a whole row goes at once.
    std::sort(waiting_.begin(), waiting_.end(), [&](std::uint32_t one, std::uint32_t other) {
      return place_along(direction, state_.particles[one].site()) >
             place_along(direction, state_.particles[other].site());
    });
    const auto goes = [&](std::uint32_t id) { return try_move(id, direction); };
    do {
      while (std::erase_if(waiting_, goes) > 0) {
      }
    } while (move_walls(direction));
  }

  Moves moves() && { return std::move(moves_); }

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

  bool try_move(std::uint32_t id, Direction direction) {
    const grains::Particle& grain = state_.particles[id];
    bool free = true;
    for_each_place(grain, footprints_.of(grain).lead[lattice::index_of(direction)],
                   [&](std::size_t place) { free = free && !occupancy_.taken(place); });
    if (!free) {
      return false;
    }
    leave(id, direction);
    enter(id, direction);
    return true;
  }

  // The two halves of a move.
  void leave(std::uint32_t id, Direction direction) {
    const grains::Particle& grain = state_.particles[id];
    for_each_place(grain, footprints_.of(grain).trail[lattice::index_of(direction)],
                   [&](std::size_t place) { occupancy_.release(place); });
  }
  void enter(std::uint32_t id, Direction direction) {
    grains::Particle& grain = state_.particles[id];
    for_each_place(
        grain, footprints_.of(grain).lead[lattice::index_of(direction)],
        [&](std::size_t place) { occupancy_.take(place, static_cast<grains::Owner>(id)); });
    const lattice::Site target = grain.site() + unit(direction);
    grain.column = target.column;
    grain.row = target.row;
    grain.previous = static_cast<grains::Move>(direction);
    take(remainders_[id], kSpacing, direction);
    moves_.moved.push_back(id);
  }

  /// Returns whether any has moved.
  bool move_walls(Direction direction) {
    bool any = false;
    for (WallMove& wall : walls_) {
      if (wall.wished != 0 && !wall.done && wall.direction(state_) == direction) {
        wall.done = push(edges_.step_of(state_, wall.wall, wall.wished));
        any = any || wall.done;
      }
    }
    return any;
  }

  bool push(const grains::WallStep& step) {
    grains::Train train(state_, occupancy_, footprints_, step);
    if (!train.gather([](std::uint32_t) { return false; })) {
      return false;
    }
    for (const std::size_t place : step.leaves) {
      occupancy_.release(place);
    }
    for (const std::uint32_t id : train.ids()) {
      leave(id, step.direction);
    }
    for (const std::uint32_t id : train.ids()) {
      enter(id, step.direction);
      keep_up(remainders_[id], step.direction);
    }
    for (const std::size_t place : step.enters) {
      occupancy_.take(place, grains::wall_code(step.wall));
    }
    note_beside(step.enters);
    note_beside(step.leaves);
    follow(train.ids());
    return true;
  }

  void note_beside(const std::vector<std::size_t>& places) {
    for (const std::size_t place : places) {
      for (const Direction direction : lattice::kDirections) {
        const grains::Owner owner =
            occupancy_.owner(state_.lattice.index(state_.lattice.site(place) + unit(direction)));
        if (grains::is_particle(owner)) {
          moves_.beside_walls.push_back(static_cast<std::uint32_t>(owner));
        }
      }
    }
  }

  /// Grains that have been pushed do not go on in this direction, but may in others.
  void follow(const std::vector<std::uint32_t>& pushed) {
    std::vector<std::uint32_t> sorted = pushed;
    std::sort(sorted.begin(), sorted.end());
    std::erase_if(waiting_, [&](std::uint32_t id) {
      return std::binary_search(sorted.begin(), sorted.end(), id);
    });
    std::vector<std::uint32_t> all(ids_.begin(), ids_.end());
    all.insert(all.end(), pushed.begin(), pushed.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    with_pushed_ = std::move(all);
    ids_ = with_pushed_;
  }

  grains::State& state_;
  std::span<Vector> remainders_;
  grains::Occupancy& occupancy_;
  const grains::FootprintTable& footprints_;
  const grains::WallEdges& edges_;
  std::span<const std::uint32_t> ids_;
  std::span<WallMove> walls_;
  std::vector<std::uint32_t> waiting_;
  std::vector<std::uint32_t> with_pushed_;
  Moves moves_;
};

}  // namespace

Moves move_all(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
               const grains::WallEdges& edges, lattice::Direction down,
               std::span<const std::uint32_t> ids, std::span<WallMove> walls) {
  Mover mover(state, occupancy, footprints, edges, ids, walls);
  for (const Direction direction : order_of_directions(state.grains, down)) {
    mover.move(direction);
  }
  return std::move(mover).moves();
}

}  // namespace clca::contact
