#pragma once
// How far particles of different size have separated.

#include <optional>

#include "clca/grains/state.hpp"

namespace clca::measure {

// The size of a species is the number of sites of its particles; species of the same size count as
// one. The floor of a bed is the lower edge of its lowest particle site, wherever walls are.

/// Mean height of the largest particles less that of the smallest, of their centres of mass, over
/// half the height of the bed. That is twice the mean height of all particle sites above the floor,
/// the height itself where the bed is evenly filled. 1 where two equal halves lie one on the other,
/// the large ones on top, -1 the other way round, 0 where they are mixed. None unless particles of
/// two sizes are present.
std::optional<double> segregation_index(const grains::State& state);

/// Mixing index of Lacey (1954), M = (s0^2 - s^2) / (s0^2 - sr^2), over the cells of a Grid of side
/// `cell` (lattice spacings): 0 where large and small are never in the same cell, 1 on the average
/// over all ways to exchange them at random. s^2 is the variance of the cells' share of the largest
/// particles, by number and weighted by particles; s0^2 = p (1 - p) that of separated ones. sr^2
/// is the expectation over random permutations, p (1 - p) (C - 1) / (N - 1) for N particles in C
/// cells: exact, where Lacey's p (1 - p) / n is for many particles in equal cells. None unless
/// particles of two sizes are present and some cell holds more than one.
std::optional<double> lacey_index(const grains::State& state, double cell);

/// Where exactly one species has exactly one particle present: the height of that intruder, 0 where
/// it lies on the floor of the bed, 1 where its top is level with the mean surface of all others,
/// more above. Both to half a spacing, for odd columns stand half a spacing higher. None where
/// the others are not deeper than the intruder is high.
std::optional<double> intruder_height(const grains::State& state);

}  // namespace clca::measure
