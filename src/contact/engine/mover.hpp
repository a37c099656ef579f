#pragma once
// Moves of one step as move_all() gives them, at a cost that follows what moves.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "contact/rule/moves.hpp"

namespace clca::contact {

/// A grain whose way is not free waits until what is in its way has moved, maybe for many steps:
/// in between it is not looked at. It may wait in several directions, in each for one other body.
class Mover {
 public:
  static constexpr double kGrainBytes =
      sizeof(std::uint8_t) + (3 * lattice::kDirectionCount + 2) * sizeof(std::int32_t) +
      grains::kListRoom *
          (3 * sizeof(std::uint32_t) + sizeof(std::pair<std::uint32_t, grains::Owner>));

  /// Both outlive the mover.
  Mover(State& state, grains::Box& box);

  /// Nobody waits any more: there are other grains, or walls.
  void clear();
  /// A grain has been taken away.
  void remove_grain(std::uint32_t id);

  /// move_all() for `ids`, which are all grains that are far enough from their sites to want a
  /// move. Their order does not matter.
  void move_all(lattice::Direction down, std::span<const std::uint32_t> ids,
                std::span<WallMove> walls);
  /// Of the last call.
  const SiteMoves& moves() const { return moves_; }
  /// Of the last call: `ids`, and those that walls have pushed.
  std::span<const std::uint32_t> ids() const { return ids_; }

 private:
  // A grain and a direction in which it may wait are a number: kDirectionCount x id + direction.
  using Waiting = std::int32_t;
  static constexpr Waiting kNone = -1;
  static Waiting waiting(std::uint32_t id, lattice::Direction direction) {
    return static_cast<Waiting>(std::size_t{id} * lattice::kDirectionCount +
                                lattice::index_of(direction));
  }
  // What others wait for: walls and the border, and each grain.
  static constexpr std::size_t kWalls = 0;
  static std::size_t obstacle(std::uint32_t id) { return id + 1; }

  bool waits(std::uint32_t id, lattice::Direction direction) const {
    return (waiting_[id] >> lattice::index_of(direction) & 1U) != 0;
  }
  void move(lattice::Direction direction, std::span<WallMove> walls);
  void try_move(std::uint32_t id, grains::Owner in_the_way, lattice::Direction direction);
  void move_ready(lattice::Direction direction);
  bool has_ring(lattice::Direction direction);
  bool move_at_once(lattice::Direction direction);
  bool move_walls(lattice::Direction direction, std::span<WallMove> walls);
  void wait(std::uint32_t id, lattice::Direction direction, std::size_t obstacle);
  void stop_waiting(Waiting entry);
  void stop_waiting_at_all(std::uint32_t id);
  void wake(std::size_t obstacle, lattice::Direction direction);

  State& state_;
  SiteMoves moves_;
  bool may_hook_;  // grains may be in the way of one another in a ring
  std::vector<std::uint32_t> ids_;
  std::vector<std::pair<std::uint32_t, grains::Owner>> tries_;  // with what is in the way
  std::vector<std::uint32_t> ready_;                            // to be tried
  std::vector<std::uint8_t> waiting_;                           // by id: directions as bits
  std::vector<Waiting> first_;                                  // by obstacle
  std::vector<std::uint32_t> obstacle_;                         // by what waits
  std::vector<Waiting> next_;                                   // of the same obstacle
  std::vector<Waiting> previous_;       // the same; of the first one -1 - obstacle
  std::vector<std::uint32_t> walk_of_;  // by id
  std::vector<std::uint32_t> pushed_;
};

}  // namespace clca::contact
