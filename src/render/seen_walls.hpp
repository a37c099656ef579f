#pragma once
// What a picture shows of the walls of a state.

#include <vector>

#include "clca/automaton/state.hpp"

namespace clca::render {

/// Whether the wall is there and has a motion.
bool moves(const automaton::Wall& wall);
/// Whether some wall does.
bool any_wall_moves(const automaton::State& state);

/// Remembers walls, to tell whether those of another state look the same. The clock of a motion
/// goes on at every step and is not seen.
class SeenWalls {
 public:
  explicit SeenWalls(const automaton::State& state);

  bool match(const automaton::State& state) const;

 private:
  struct Seen {
    bool present = false;
    bool moving = false;
    lattice::Axial shift;
    std::vector<lattice::Site> sites;  // at home; none of a wall that is not there

    bool looks_like(const automaton::Wall& wall) const;
  };
  std::vector<Seen> walls_;
};

}  // namespace clca::render
