#pragma once
// Moves of one step, site by site into free sites.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/walls.hpp"
#include "grains/internal/pushed_cluster.hpp"

namespace clca::contact {

/// Moves grains and walls by single sites and records the moves.
class SiteMoves {
 public:
  /// Both must outlive this object; the box is that of the state.
  SiteMoves(State& state, grains::Box& box) : state_(state), box_(box) {}

  /// Starts a step: clears the record.
  void begin();

  /// An owner that blocks a grain; kFree if there is none.
  grains::Owner in_the_way(std::uint32_t id, lattice::Direction direction) const;
  /// Moves a grain into free sites.
  void move(std::uint32_t id, lattice::Direction direction);
  /// Those of the grains `blocked` that can only move at once: each is blocked by others of them
  /// alone. Shapes that hook into one another are.
  std::vector<std::uint32_t> movable_at_once(std::vector<std::uint32_t> blocked,
                                             lattice::Direction direction) const;
  void move_at_once(std::span<const std::uint32_t> ids, lattice::Direction direction);
  /// Moves the walls that are due in this direction and have not moved yet, with all grains they
  /// push.
  /// A wall blocked by the border or another wall stays. Returns whether any wall moved; appends
  /// the pushed grains.
  bool move_walls(lattice::Direction direction, std::span<WallMove> walls,
                  std::vector<std::uint32_t>& pushed);

  /// Ids of grains that moved in this step, without duplicates.
  const std::vector<std::uint32_t>& moved() const { return moved_; }
  /// Whether a grain has left the neighbourhood of its anchor in this step.
  bool advanced() const { return advanced_; }
  /// Grains next to sites that walls entered or left; may have duplicates.
  const std::vector<std::uint32_t>& beside_walls() const { return beside_walls_; }

 private:
  /// The first owner in the way that `chosen` returns true for; kFree if there is none.
  template <class Chosen>
  grains::Owner in_the_way(std::uint32_t id, lattice::Direction direction, Chosen chosen) const;
  void leave(std::uint32_t id, lattice::Direction direction);
  void enter(std::uint32_t id, lattice::Direction direction);
  bool push(const grains::WallStep& step, std::vector<std::uint32_t>& pushed);
  void note_neighbours(const std::vector<std::size_t>& indices);

  State& state_;
  grains::Box& box_;
  std::vector<std::uint32_t> moved_;
  std::vector<std::uint32_t> beside_walls_;
  bool advanced_ = false;
};

/// Moves each grain by one site in every direction in which its remainder is large enough and the
/// sites are free; chains of grains move at once.
/// Walls make their moves; grains they pushed may still move in later directions. `down`: lattice
/// direction nearest to gravity.
void move_all(SiteMoves& moves, State& state, lattice::Direction down, std::span<WallMove> walls);

}  // namespace clca::contact
