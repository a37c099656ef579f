#pragma once
// A world in which nothing but the walls moves.

#include <utility>

#include "automaton/rule/world.hpp"
#include "support/states.hpp"

namespace clca::testing {

class WallBench {
 public:
  explicit WallBench(grains::State start) : state(std::move(start)) {}

  /// Lets the walls take one step. Returns whether any has moved.
  bool advance() {
    const bool moved = advance_walls(world);
    ++state.step;
    return moved;
  }
  lattice::Site site(std::size_t id) const { return state.particles[id].site(); }
  const grains::Travel& travel(std::size_t wall) const { return state.walls[wall].travel; }

  grains::State state;
  grains::Box box{state};
  automaton::World world{box, automaton::Rules()};
};

/// A wall that goes one site a step.
inline grains::Wall driven_wall(std::vector<lattice::Site> sites, lattice::Direction direction,
                                grains::PassiveRule passive, int distance = 100) {
  return {.sites = std::move(sites),
          .motion = grains::WallMotion{direction, grains::Drive{1, distance}},
          .passive_rule = passive,
          .travel = {.active = true}};
}

/// A row of sites through the whole box.
inline std::vector<lattice::Site> whole_row(const grains::State& state, int row) {
  std::vector<lattice::Site> sites;
  for (int column = 0; column < state.lattice.columns(); ++column) {
    sites.push_back({column, row});
  }
  return sites;
}

}  // namespace clca::testing
