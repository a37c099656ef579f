#pragma once
// The wall-removal test at any size.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "clca/automaton/automaton.hpp"

namespace clca::bench {

/// A rain of `particles` small and large hexagons, 1:1, over a bed as wide as it will be high,
/// behind a wall with as much room beside it. At 540 particles this is scenes/wall-removal.yaml.
inline automaton::Automaton rain(std::size_t particles, automaton::TieBreaking ties, int threads) {
  const double scale = std::sqrt(static_cast<double>(particles) / 540);
  const double width = 87 * scale;
  const double height = 460 * scale;
  grains::State state{.lattice = lattice::Lattice::covering(300 * scale, height, false),
                      .seed = 2001};
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  state.walls = {{.sites = lattice::sites_in(state.lattice, {width, 0, width + 1, height})}};
  automaton::Automaton automaton(std::move(state), {.ties = ties}, {.threads = threads});
  const std::vector<std::size_t> counts = {particles / 2, particles / 2};
  automaton.fill({0, 0, width, height}, counts);
  return automaton;
}

/// Steps until nothing moves or `most` steps are done.
inline void run_steps(automaton::Automaton& automaton, std::uint64_t most) {
  for (std::uint64_t step = 0; step < most && !automaton.step().settled; ++step) {
  }
}

}  // namespace clca::bench
