#pragma once
// How walls look in a picture.

#include <vector>

#include "clca/grains/state.hpp"

namespace clca::render {

/// Whether the wall is present and has a motion.
bool moves(const grains::Wall& wall);
/// Whether some present wall has a motion.
bool any_wall_moves(const grains::State& state);

/// Remembers how walls look, to detect changes. The clock of a motion changes in every step and
/// does not count.
class WallsAppearance {
 public:
  explicit WallsAppearance(const grains::State& state);

  bool match(const grains::State& state) const;

 private:
  struct WallAppearance {
    bool present = false;
    bool moving = false;
    lattice::Axial shift;
    std::vector<lattice::Site> sites;  // at home; none of a wall that is not there

    bool looks_like(const grains::Wall& wall) const;
  };
  std::vector<WallAppearance> walls_;
};

}  // namespace clca::render
