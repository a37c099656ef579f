#pragma once
// Moves of one step, site by site where there is room.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "clca/grains/footprint.hpp"
#include "clca/parallel/split.hpp"
#include "contact/rule/walls.hpp"
#include "grains/wall_step.hpp"

namespace clca::contact {

/// What moves of a step have changed: ids of grains.
struct Moves {
  std::vector<std::uint32_t> moved;  ///< each once
  /// Beside places that walls have entered or left, some more than once.
  std::vector<std::uint32_t> beside_walls;
};

/// Carries out moves; keeps its buffers from step to step.
class Mover {
 public:
  /// All outlive the mover.
  Mover(State& state, grains::Occupancy& occupancy, const grains::FootprintTable& footprints,
        const grains::WallEdges& edges, const parallel::Threads& threads = {});

  /// Moves each of the grains `ids` by a site in every direction in which its remainder asks for
  /// it and its way is free; one that follows another goes with it. Each of the walls takes the
  /// move that it wants, and takes along what is in its way, and what is in the way of that, unless
  /// the border or another wall is. What has been pushed may move like `ids` in the directions that
  /// follow. `down`: the direction of the lattice nearest to gravity. None of the grains has a
  /// `previous` move when this begins. The order of `ids` does not matter for where they go. The
  /// result is valid until the next call.
  const Moves& move_all(lattice::Direction down, std::span<const std::uint32_t> ids,
                        std::span<WallMove> walls);

  /// Of the last call: `ids`, and those that walls have pushed.
  std::span<const std::uint32_t> ids() const { return ids_; }

 private:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  void move(lattice::Direction direction, std::span<WallMove> walls);
  void try_move(std::uint32_t id, grains::Owner obstacle, lattice::Direction direction);
  void move_ready(lattice::Direction direction);
  void wait(std::uint32_t id, std::size_t obstacle);
  void end_waiting(std::size_t obstacle);
  template <class Visit>
  void for_each_place(const grains::Particle& grain, const std::vector<lattice::Offset>& offsets,
                      Visit visit) const;
  grains::Owner in_the_way(std::uint32_t id, lattice::Direction direction) const;
  void leave(std::uint32_t id, lattice::Direction direction);
  void enter(std::uint32_t id, lattice::Direction direction);
  bool move_walls(lattice::Direction direction, std::span<WallMove> walls);
  bool push(const grains::WallStep& step);
  void note_beside(const std::vector<std::size_t>& places);
  void follow(std::vector<std::uint32_t> pushed);

  State& state_;
  grains::Occupancy& occupancy_;
  const grains::FootprintTable& footprints_;
  const grains::WallEdges& edges_;
  parallel::Threads threads_;
  std::vector<std::uint32_t> ids_;
  parallel::PartLists<std::pair<std::uint32_t, grains::Owner>> tries_;  // with what is in the way
  std::vector<std::uint32_t> ready_;                                    // to be tried
  // Grains that wait until what is in their way moves. Obstacles are grains by id, and one more for
  // all walls and the border.
  std::vector<std::uint32_t> first_waiting_;  // by obstacle
  std::vector<std::uint32_t> next_waiting_;   // by id
  std::vector<std::size_t> obstacles_;        // for which grains have waited
  Moves moves_;
};

}  // namespace clca::contact
