#include <algorithm>
#include <iterator>
#include <utility>

#include "contact/engine/engine.hpp"

namespace clca::contact {

using lattice::Direction;

void Mover::clear() {
  waiting_directions_.clear();
  first_waiting_.clear();
  next_waiting_.clear();
  previous_waiting_.clear();
}

void Mover::remove_grain(std::uint32_t id) {
  if (id < waiting_directions_.size()) {
    end_waits({&id, 1}, Direction::up);  // in no step: nobody is tried
    ready_.clear();
  }
}

void Mover::move_all(Direction down, std::span<const std::uint32_t> ids,
                     std::span<WallMove> walls) {
  ids_.assign(ids.begin(), ids.end());
  moves_.begin_step();
  const std::size_t grains = state_.grains.particles.size();
  waiting_directions_.resize(grains, 0);
  walk_of_.resize(grains, 0);
  first_waiting_.resize(grains + 1, kNone);
  obstacle_.resize(lattice::kDirectionCount * grains);
  next_waiting_.resize(lattice::kDirectionCount * grains, kNone);
  previous_waiting_.resize(lattice::kDirectionCount * grains, kNone);
  for (const Direction direction : direction_order(state_.grains, down)) {
    move(direction, walls);
  }
}

void Mover::move(Direction direction, std::span<WallMove> walls) {
  blocked_.clear();
  for (const std::uint32_t id : ids_) {
    if (waits(id, direction)) {
      blocked_.push_back(id);
    } else if (is_move_due(state_.remainders[id], direction)) {
      ready_.push_back(id);
    }
  }
  do {
    while (!ready_.empty()) {
      const std::uint32_t id = ready_.back();
      ready_.pop_back();
      if (!wait_if_blocked(id, direction)) {
        move({&id, 1}, direction);
      }
    }
  } while (move_at_once(direction) || move_walls(direction, walls));
}

void Mover::move(std::span<const std::uint32_t> ids, Direction direction) {
  moves_.move(ids, direction);
  end_waits(ids, direction);
}

/// Grains have moved: they wait no more, and those that wait for them are tried.
void Mover::end_waits(std::span<const std::uint32_t> ids, Direction direction) {
  for (const std::uint32_t id : ids) {
    for (const Direction other : lattice::kDirections) {
      if (waits(id, other)) {
        stop_waiting(waiting(id, other));
      }
    }
  }
  for (const std::uint32_t id : ids) {
    wake(obstacle(id), direction);
  }
}

/// Whether some grain waits for one that waits for one ... that waits for it.
bool Mover::has_ring(Direction direction) {
  std::erase_if(blocked_, [&](std::uint32_t id) { return !waits(id, direction); });
  const std::uint64_t before = walks_;
  for (std::uint32_t id : blocked_) {
    ++walks_;
    while (waits(id, direction) && walk_of_[id] <= before) {
      walk_of_[id] = walks_;
      const std::uint32_t waits_for = obstacle_[static_cast<std::size_t>(waiting(id, direction))];
      if (waits_for == kWalls) {
        break;
      }
      id = waits_for - 1;
      if (waits(id, direction) && walk_of_[id] == walks_) {
        return true;
      }
    }
  }
  return false;
}

bool Mover::move_at_once(Direction direction) {
  if (!has_ring(direction)) {
    return false;
  }
  std::vector<std::uint32_t> blocked;
  std::ranges::copy_if(ids_, std::back_inserter(blocked), [&](std::uint32_t id) {
    return waits(id, direction) && is_move_due(state_.remainders[id], direction);
  });
  const std::vector<std::uint32_t> ids = moves_.movable_at_once(std::move(blocked), direction);
  move(ids, direction);
  return !ids.empty();
}

/// Grains that a wall has pushed do not move by themselves in the same direction.
bool Mover::move_walls(Direction direction, std::span<WallMove> walls) {
  std::vector<std::uint32_t> pushed;
  if (!moves_.move_walls(direction, walls, pushed)) {
    return false;
  }
  end_waits(pushed, direction);
  wake(kWalls, direction);
  ids_.insert(ids_.end(), pushed.begin(), pushed.end());
  std::ranges::sort(ids_);
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  return true;
}

/// Lets a grain wait for what is in its way. Returns false if that is free.
bool Mover::wait_if_blocked(std::uint32_t id, Direction direction) {
  const grains::Owner in_the_way = moves_.blocking_owner(id, direction);
  if (in_the_way == grains::kFree) {
    return false;
  }
  const std::size_t obstacle =
      grains::is_particle(in_the_way) ? Mover::obstacle(grains::particle_id(in_the_way)) : kWalls;
  const Waiting entry = waiting(id, direction);
  const auto at = static_cast<std::size_t>(entry);
  blocked_.push_back(id);
  waiting_directions_[id] =
      static_cast<std::uint8_t>(waiting_directions_[id] | 1U << lattice::index_of(direction));
  obstacle_[at] = static_cast<std::uint32_t>(obstacle);
  next_waiting_[at] = std::exchange(first_waiting_[obstacle], entry);
  previous_waiting_[at] = -1 - static_cast<Waiting>(obstacle);
  if (next_waiting_[at] != kNone) {
    previous_waiting_[static_cast<std::size_t>(next_waiting_[at])] = entry;
  }
  return true;
}

void Mover::stop_waiting(Waiting entry) {
  const auto at = static_cast<std::size_t>(entry);
  const Waiting previous = previous_waiting_[at];
  (previous < 0 ? first_waiting_[static_cast<std::size_t>(-1 - previous)]
                : next_waiting_[static_cast<std::size_t>(previous)]) = next_waiting_[at];
  if (next_waiting_[at] != kNone) {
    previous_waiting_[static_cast<std::size_t>(next_waiting_[at])] = previous;
  }
  std::uint8_t& directions = waiting_directions_[at / lattice::kDirectionCount];
  directions = static_cast<std::uint8_t>(directions & ~(1U << at % lattice::kDirectionCount));
}

/// Tries the grains that wait for this obstacle in this direction and still want to move.
void Mover::wake(std::size_t obstacle, Direction direction) {
  while (first_waiting_[obstacle] != kNone) {
    const auto at = static_cast<std::size_t>(first_waiting_[obstacle]);
    const auto id = static_cast<std::uint32_t>(at / lattice::kDirectionCount);
    stop_waiting(first_waiting_[obstacle]);
    if (at % lattice::kDirectionCount == lattice::index_of(direction) &&
        is_move_due(state_.remainders[id], direction)) {
      ready_.push_back(id);
    }
  }
}

}  // namespace clca::contact
