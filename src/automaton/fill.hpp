#pragma once
// Placing particles at random where there is room.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/automaton/automaton.hpp"

namespace clca::automaton {

/// See Automaton::fill. New particles are appended to `state` and entered in `occupancy`.
FillResult fill_region(State& state, Occupancy& occupancy, const lattice::Rectangle& region,
                       std::span<const std::size_t> counts);

/// True when the particle stands in the box on free sites only.
bool fits(const State& state, const Occupancy& occupancy, const Particle& particle);

/// True when every site of the particle lies in the region.
bool lies_inside(const State& state, const Particle& particle, const lattice::Rectangle& region);

/// Appends the particle, which must fit, and enters it in `occupancy`.
void insert(State& state, Occupancy& occupancy, const Particle& particle);

/// The kinds of a species: one for each orientation.
std::vector<std::uint16_t> kinds_of(const State& state, std::size_t species);

/// Numbers the particles from `first` on up the columns from the left, so that neighbours in the
/// box are neighbours in memory.
void renumber(State& state, Occupancy& occupancy, std::size_t first);

}  // namespace clca::automaton
