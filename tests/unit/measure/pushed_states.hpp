#pragma once
// States in which a plate has come onto particles.

#include <vector>

#include "support/states.hpp"

namespace clca::testing {

inline grains::Wall plate(std::vector<lattice::Site> sites,
                          lattice::Direction direction = lattice::Direction::down) {
  return {.sites = std::move(sites),
          .motion = grains::WallMotion{.direction = direction, .program = grains::Drive{}},
          .passive_rule = grains::PassiveRule::overlap};
}

/// One row of sites, columns `first` to `last`.
inline std::vector<lattice::Site> row_of_sites(int first, int last, int row) {
  std::vector<lattice::Site> sites;
  for (int column = first; column <= last; ++column) {
    sites.push_back({column, row});
  }
  return sites;
}

/// A pair of hexagons of radius 1, one above the other, that share the site (column, row). The
/// upper one was pushed down onto the lower one, from wall 0.
inline void add_pair(grains::State& state, int column, int row) {
  const auto upper = static_cast<std::uint32_t>(state.particles.size());
  state.particles.push_back(particle_at(column, row + 1));
  state.particles.push_back(particle_at(column, row - 1));
  state.pushes.push_back({.pushed = upper + 1, .pusher = grains::as_owner(upper)});
}

/// A plate over columns 8 to 12 at row 12, moving down, that has come onto particle 0 at (10, 12),
/// and this onto particle 1 at (10, 10); hexagons of radius 1.
inline grains::State pushed_state() {
  grains::State state = empty_state(40, 40);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  state.walls = {plate(row_of_sites(8, 12, 12))};
  state.pushes = {{.pushed = 0, .pusher = grains::kFirstWall}};
  add_pair(state, 10, 10);
  return state;
}

}  // namespace clca::testing
