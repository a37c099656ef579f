#pragma once
// States that many tests start from.

#include <cstdint>

#include "clca/automaton/automaton.hpp"

namespace clca::testing {

/// An empty box.
inline grains::State empty_state(int columns, int rows, std::uint64_t seed = 1) {
  return {.lattice = lattice::Lattice(columns, rows, false), .seed = seed};
}

inline grains::Particle particle_at(int column, int row, std::uint16_t kind = 0) {
  return {.column = column, .row = row, .kind = kind};
}

/// Two species, a particle, a wall that moves, a source.
inline grains::State good_state() {
  grains::State state = empty_state(40, 40);
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  state.particles = {particle_at(10, 10)};
  state.walls = {
      {.sites = {{30, 30}},
       .motion = grains::WallMotion{.direction = lattice::Direction::down,
                                    .program = grains::Drive{.period = 2, .distance = 5}}}};
  state.sources = {{.sites = {{20, 30}}, .weights = {1, 1}}};
  return state;
}

/// Hexagons of radius 1 and 2 thrown into a box, `count` of each.
inline automaton::Automaton mixed_automaton(int columns, int rows, std::size_t count,
                                            std::uint64_t seed = 1) {
  grains::State state = empty_state(columns, rows, seed);
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  automaton::Automaton automaton(std::move(state));
  const std::vector<std::size_t> counts = {count, count};
  automaton.fill({0, 0, 1e6, 1e6}, counts);
  return automaton;
}

inline void settle(automaton::Automaton& automaton) {
  while (!automaton.step().settled) {
  }
}

}  // namespace clca::testing
