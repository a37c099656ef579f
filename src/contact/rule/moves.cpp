#include "contact/rule/moves.hpp"

#include <algorithm>
#include <utility>

#include "contact/rule/order.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

using lattice::Direction;

Mover::Mover(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
             const grains::WallEdges& edges, const parallel::Threads& threads)
    : state_(state),
      occupancy_(occupancy),
      footprints_(footprints),
      edges_(edges),
      threads_(threads),
      tries_(threads) {}

const Moves& Mover::move_all(Direction down, std::span<const std::uint32_t> ids,
                             std::span<WallMove> walls) {
  ids_.assign(ids.begin(), ids.end());
  moves_.moved.clear();
  moves_.beside_walls.clear();
  const std::size_t grains = state_.grains.particles.size();
  first_waiting_.resize(grains + 1, kNobody);
  next_waiting_.resize(grains);
  for (const Direction direction : order_of_directions(state_.grains, down)) {
    move(direction, walls);
  }
  return moves_;
}

void Mover::move(Direction direction, std::span<WallMove> walls) {
  tries_.clear();
  parallel::split(threads_, ids_.size(),
                  [&](std::size_t part, std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i) {
                      if (wants(state_.remainders[ids_[i]], direction)) {
                        tries_.of(part).emplace_back(ids_[i], in_the_way(ids_[i], direction));
                      }
                    }
                  });
  for (const bool is_free : {false, true}) {  // those that wait have to be there when others go
    tries_.for_each([&](const auto& one) {
      if ((one.second == grains::kFree) == is_free) {
        try_move(one.first, one.second, direction);
      }
    });
  }
  do {
    move_ready(direction);
  } while (move_walls(direction, walls));
  for (const std::size_t obstacle : obstacles_) {
    first_waiting_[obstacle] = kNobody;
  }
  obstacles_.clear();
}

/// A grain whose way is not free waits until what is in its way has moved, so that a whole row goes
/// at once.
void Mover::try_move(std::uint32_t id, grains::Owner obstacle, Direction direction) {
  if (obstacle == grains::kFree) {
    leave(id, direction);
    enter(id, direction);
    end_waiting(id);
  } else {
    wait(id,
         grains::is_particle(obstacle) ? static_cast<std::size_t>(obstacle) : next_waiting_.size());
  }
}

void Mover::move_ready(Direction direction) {
  while (!ready_.empty()) {
    const std::uint32_t id = ready_.back();
    ready_.pop_back();
    try_move(id, in_the_way(id, direction), direction);
  }
}

void Mover::wait(std::uint32_t id, std::size_t obstacle) {
  if (first_waiting_[obstacle] == kNobody) {
    obstacles_.push_back(obstacle);
  }
  next_waiting_[id] = std::exchange(first_waiting_[obstacle], id);
}

void Mover::end_waiting(std::size_t obstacle) {
  for (std::uint32_t id = std::exchange(first_waiting_[obstacle], kNobody); id != kNobody;
       id = next_waiting_[id]) {
    ready_.push_back(id);
  }
}

template <class Visit>
void Mover::for_each_place(const grains::Particle& grain,
                           const std::vector<lattice::Offset>& offsets, Visit visit) const {
  const lattice::Lattice& lattice = state_.grains.lattice;
  const std::size_t place = lattice.index(grain.site());
  const int column = lattice.wrapped(grain.column);
  for (const lattice::Offset offset : offsets) {
    visit(lattice.at(place, column, offset));
  }
}

/// One of those in the way of a move, kFree where there are none.
grains::Owner Mover::in_the_way(std::uint32_t id, Direction direction) const {
  const grains::Particle& grain = state_.grains.particles[id];
  const lattice::Lattice& lattice = state_.grains.lattice;
  const std::size_t place = lattice.index(grain.site());
  const int column = lattice.wrapped(grain.column);
  for (const lattice::Offset offset : footprints_.of(grain).lead[lattice::index_of(direction)]) {
    const grains::Owner owner = occupancy_.owner(lattice.at(place, column, offset));
    if (owner != grains::kFree) {
      return owner;
    }
  }
  return grains::kFree;
}

// The two halves of a move.
void Mover::leave(std::uint32_t id, Direction direction) {
  const grains::Particle& grain = state_.grains.particles[id];
  for_each_place(grain, footprints_.of(grain).trail[lattice::index_of(direction)],
                 [&](std::size_t place) { occupancy_.release(place); });
}

void Mover::enter(std::uint32_t id, Direction direction) {
  grains::Particle& grain = state_.grains.particles[id];
  for_each_place(
      grain, footprints_.of(grain).lead[lattice::index_of(direction)],
      [&](std::size_t place) { occupancy_.take(place, static_cast<grains::Owner>(id)); });
  const lattice::Site target = grain.site() + unit(direction);
  grain.column = target.column;
  grain.row = target.row;
  if (grain.previous == grains::kRest) {
    moves_.moved.push_back(id);
  }
  grain.previous = static_cast<grains::Move>(direction);
  take(state_.remainders[id], kSpacing, direction);
}

/// Returns whether any has moved.
bool Mover::move_walls(Direction direction, std::span<WallMove> walls) {
  bool any = false;
  for (WallMove& wall : walls) {
    if (wall.wished != 0 && !wall.done && wall.direction(state_.grains) == direction) {
      wall.done = push(edges_.step_of(state_.grains, wall.wall, wall.wished));
      any = any || wall.done;
    }
  }
  return any;
}

bool Mover::push(const grains::WallStep& step) {
  grains::Train train(state_.grains, occupancy_, footprints_, step);
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
    keep_up(state_.remainders[id], step.direction);
  }
  for (const std::size_t place : step.enters) {
    occupancy_.take(place, grains::wall_code(step.wall));
  }
  note_beside(step.enters);
  note_beside(step.leaves);
  follow(train.ids());
  return true;
}

void Mover::note_beside(const std::vector<std::size_t>& places) {
  const lattice::Lattice& lattice = state_.grains.lattice;
  for (const std::size_t place : places) {
    for (const Direction direction : lattice::kDirections) {
      const grains::Owner owner =
          occupancy_.owner(lattice.index(lattice.site(place) + unit(direction)));
      if (grains::is_particle(owner)) {
        moves_.beside_walls.push_back(static_cast<std::uint32_t>(owner));
      }
    }
  }
}

/// Grains that have waited are tried again, but for those that were pushed: they may go on in the
/// directions that follow.
void Mover::follow(std::vector<std::uint32_t> pushed) {
  for (const std::size_t obstacle : obstacles_) {
    end_waiting(obstacle);
  }
  obstacles_.clear();
  std::sort(pushed.begin(), pushed.end());
  std::erase_if(ready_, [&](std::uint32_t id) {
    return std::binary_search(pushed.begin(), pushed.end(), id);
  });
  ids_.insert(ids_.end(), pushed.begin(), pushed.end());
  std::sort(ids_.begin(), ids_.end());
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
}

}  // namespace clca::contact
