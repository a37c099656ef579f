#pragma once
// Moves of one step, site by site where there is room.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/footprint.hpp"
#include "contact/rule/walls.hpp"
#include "grains/wall_step.hpp"

namespace clca::contact {

/// Moves grains and walls by single sites, and keeps account of it.
class SiteMoves {
 public:
  /// All outlive it.
  SiteMoves(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
            const grains::WallEdges& edges)
      : state_(state), occupancy_(occupancy), footprints_(footprints), edges_(edges) {}

  /// Begins a step: nothing has moved, and no grain has a `previous` move.
  void begin();

  /// One of those in the way of a grain, kFree where there is none.
  grains::Owner in_the_way(std::uint32_t id, lattice::Direction direction) const;
  /// Moves a grain whose way is free.
  void move(std::uint32_t id, lattice::Direction direction);
  /// Moves the walls that want this direction and have not moved yet. A wall takes along what is in
  /// its way, and what is in the way of that, unless the border or another wall is. Returns whether
  /// any has moved, and adds the grains that were pushed.
  bool move_walls(lattice::Direction direction, std::span<WallMove> walls,
                  std::vector<std::uint32_t>& pushed);

  /// Ids of grains that have moved in this step, each once.
  const std::vector<std::uint32_t>& moved() const { return moved_; }
  /// Those beside places that walls have entered or left, some more than once.
  const std::vector<std::uint32_t>& beside_walls() const { return beside_walls_; }

 private:
  template <class Visit>
  void for_each_place(const grains::Particle& grain, const std::vector<lattice::Offset>& offsets,
                      Visit visit) const;
  void leave(std::uint32_t id, lattice::Direction direction);
  void enter(std::uint32_t id, lattice::Direction direction);
  bool push(const grains::WallStep& step, std::vector<std::uint32_t>& pushed);
  void note_beside(const std::vector<std::size_t>& places);

  State& state_;
  grains::Occupancy& occupancy_;
  const grains::FootprintTable& footprints_;
  const grains::WallEdges& edges_;
  std::vector<std::uint32_t> moved_;
  std::vector<std::uint32_t> beside_walls_;
};

/// Moves each grain by a site in every direction in which its remainder asks for it and its way is
/// free; a row of grains goes at once. Walls take the moves that they want. What they have pushed
/// may move by itself in the directions that follow. `down`: the direction of the lattice nearest
/// to gravity.
void move_all(SiteMoves& moves, State& state, lattice::Direction down, std::span<WallMove> walls);

}  // namespace clca::contact
