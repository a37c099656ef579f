#pragma once
// What a picture shows of the walls of a state.

#include <vector>

#include "clca/grains/state.hpp"

namespace clca::render {

/// Whether the wall is there and has a motion.
bool moves(const grains::Wall& wall);
/// Whether some wall does.
bool any_wall_moves(const grains::State& state);

/// Remembers walls, to tell whether those of another state look the same. The clock of a motion
/// goes on at every step and is not seen.
class SeenWalls {
 public:
  explicit SeenWalls(const grains::State& state);

  bool match(const grains::State& state) const;

 private:
  struct Seen {
    bool present = false;
    bool moving = false;
    lattice::Axial shift;
    std::vector<lattice::Site> sites;  // at home; none of a wall that is not there

    bool looks_like(const grains::Wall& wall) const;
  };
  std::vector<Seen> walls_;
};

}  // namespace clca::render
