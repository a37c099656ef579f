#include "contact/rule/moves.hpp"

#include <algorithm>
#include <utility>

#include "contact/rule/order.hpp"
#include "contact/rule/remainders.hpp"

namespace clca::contact {

using lattice::Direction;

void SiteMoves::begin() {
  moved_.clear();
  beside_walls_.clear();
  advanced_ = false;
}

template <class Chosen>
grains::Owner SiteMoves::in_the_way(std::uint32_t id, Direction direction, Chosen chosen) const {
  const grains::Particle& grain = state_.grains.particles[id];
  const lattice::Lattice& lattice = state_.grains.lattice;
  const std::size_t index = lattice.index(grain.site());
  const int column = lattice.wrapped(grain.column);
  for (const lattice::Offset offset :
       box_.footprints.of(grain).lead[lattice::index_of(direction)]) {
    const grains::Owner owner = box_.occupancy.owner(lattice.at(index, column, offset));
    if (owner != grains::kFree && chosen(owner)) {
      return owner;
    }
  }
  return grains::kFree;
}

grains::Owner SiteMoves::in_the_way(std::uint32_t id, Direction direction) const {
  return in_the_way(id, direction, [](grains::Owner /*any*/) { return true; });
}

std::vector<std::uint32_t> SiteMoves::movable_at_once(std::vector<std::uint32_t> blocked,
                                                      Direction direction) const {
  std::sort(blocked.begin(), blocked.end());
  for (std::vector<std::uint32_t> before; before.size() != blocked.size();) {
    before = blocked;
    std::erase_if(blocked, [&](std::uint32_t id) {
      return in_the_way(id, direction, [&](grains::Owner owner) {
               return !grains::is_particle(owner) ||
                      !std::binary_search(before.begin(), before.end(), grains::particle_id(owner));
             }) != grains::kFree;
    });
  }
  return blocked;
}

void SiteMoves::move(std::uint32_t id, Direction direction) {
  leave(id, direction);
  enter(id, direction);
}

void SiteMoves::move_at_once(std::span<const std::uint32_t> ids, Direction direction) {
  for (const std::uint32_t id : ids) {
    leave(id, direction);
  }
  for (const std::uint32_t id : ids) {
    enter(id, direction);
  }
}

// The two halves of a move.
void SiteMoves::leave(std::uint32_t id, Direction direction) {
  const grains::Particle& grain = state_.grains.particles[id];
  box_.for_each_index(grain, box_.footprints.of(grain).trail[lattice::index_of(direction)],
                      [&](std::size_t index) { box_.occupancy.release(index); });
}

void SiteMoves::enter(std::uint32_t id, Direction direction) {
  grains::Particle& grain = state_.grains.particles[id];
  box_.for_each_index(grain, box_.footprints.of(grain).lead[lattice::index_of(direction)],
                      [&](std::size_t index) { box_.occupancy.take(index, grains::as_owner(id)); });
  grain = grains::moved(grain, direction);
  if (grain.previous == grains::kRest) {
    moved_.push_back(id);
  }
  grain.previous = static_cast<grains::Move>(direction);
  take(state_.remainders[id], kSpacing, direction);
  lattice::Axial& from_anchor = state_.from_anchors[id];
  from_anchor = from_anchor + unit(direction);
  if (length(from_anchor) > 1) {
    from_anchor = {};
    advanced_ = true;
  }
}

bool SiteMoves::move_walls(Direction direction, std::span<WallMove> walls,
                           std::vector<std::uint32_t>& pushed) {
  bool any = false;
  for (WallMove& wall : walls) {
    if (wall.desired != 0 && !wall.done && wall.direction(state_.grains) == direction) {
      wall.done = push(box_.edges.step_of(state_.grains, wall.wall, wall.desired), pushed);
      any = any || wall.done;
    }
  }
  return any;
}

bool SiteMoves::push(const grains::WallStep& step, std::vector<std::uint32_t>& pushed) {
  grains::PushedCluster cluster(box_, step);
  if (!cluster.gather([](std::uint32_t) { return false; })) {
    return false;
  }
  for (const std::size_t index : step.leaves) {
    box_.occupancy.release(index);
  }
  for (const std::uint32_t id : cluster.ids()) {
    leave(id, step.direction);
  }
  for (const std::uint32_t id : cluster.ids()) {
    enter(id, step.direction);
    follow_push(state_.remainders[id], step.direction);
  }
  for (const std::size_t index : step.enters) {
    box_.occupancy.take(index, grains::wall_code(step.wall));
  }
  note_neighbours(step.enters);
  note_neighbours(step.leaves);
  pushed.insert(pushed.end(), cluster.ids().begin(), cluster.ids().end());
  return true;
}

void SiteMoves::note_neighbours(const std::vector<std::size_t>& indices) {
  const lattice::Lattice& lattice = state_.grains.lattice;
  for (const std::size_t index : indices) {
    for (const Direction direction : lattice::kDirections) {
      const grains::Owner owner =
          box_.occupancy.owner(lattice.index(lattice.site(index) + unit(direction)));
      if (grains::is_particle(owner)) {
        beside_walls_.push_back(grains::particle_id(owner));
      }
    }
  }
}

void move_all(SiteMoves& moves, State& state, Direction down, std::span<WallMove> walls) {
  const auto& grains = state.grains.particles;
  for (const Direction direction : order_of_directions(state.grains, down)) {
    std::vector<bool> moved(grains.size(), false);
    const auto move_grains = [&] {
      bool any = false;
      for (std::uint32_t id = 0; id < grains.size(); ++id) {
        if (grains[id].present && !moved[id] && is_move_due(state.remainders[id], direction) &&
            moves.in_the_way(id, direction) == grains::kFree) {
          moves.move(id, direction);
          moved[id] = true;
          any = true;
        }
      }
      return any;
    };
    const auto move_at_once = [&] {
      std::vector<std::uint32_t> blocked;
      for (std::uint32_t id = 0; id < grains.size(); ++id) {
        if (grains[id].present && !moved[id] && is_move_due(state.remainders[id], direction)) {
          blocked.push_back(id);
        }
      }
      const std::vector<std::uint32_t> ids = moves.movable_at_once(std::move(blocked), direction);
      moves.move_at_once(ids, direction);
      for (const std::uint32_t id : ids) {
        moved[id] = true;
      }
      return !ids.empty();
    };
    const auto move_walls = [&] {
      std::vector<std::uint32_t> pushed;
      const bool any = moves.move_walls(direction, walls, pushed);
      for (const std::uint32_t id : pushed) {
        moved[id] = true;
      }
      return any;
    };
    while (move_grains() || move_at_once() || move_walls()) {
    }
  }
}

}  // namespace clca::contact
