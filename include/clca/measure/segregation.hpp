#pragma once
// Segregation of particles by size.

#include <optional>

#include "clca/grains/state.hpp"

namespace clca::measure {

// The size of a species is its number of sites; species of equal size count as one. The floor of a
// bed is the lower edge of its lowest particle site.

/// Mean height of the largest particles minus that of the smallest (centres of mass), divided by
/// half the bed height; the bed height is twice the mean height of all particle sites.
/// 1 if two equal halves are separated with the large particles on top, -1 the other way round, 0
/// if mixed. None unless two sizes are present.
std::optional<double> segregation_index(const grains::State& state);

/// Mixing index of Lacey (1954), M = (s0^2 - s^2) / (s0^2 - sr^2), on a Grid of side `cell`
/// (lattice spacings): 0 if separated, 1 on average if mixed at random. s^2: variance of the share
/// of the largest particles over cells, by number, weighted by particles. s0^2 = p (1 - p),
/// separated. sr^2 = p (1 - p) (C - 1) / (N - 1), the exact expectation over random permutations of
/// N particles in C cells. None unless two sizes are present and some cell holds more than one
/// particle.
std::optional<double> lacey_index(const grains::State& state, double cell);

/// Height of an intruder, the only particle of its species: 0 on the floor of the bed, 1 if its top
/// is level with the mean surface of the others, larger above. Resolution half a spacing.
/// None unless exactly one species has exactly one particle and the bed is deeper than the intruder
/// is high.
std::optional<double> intruder_height(const grains::State& state);

}  // namespace clca::measure
