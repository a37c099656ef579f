#pragma once
// Single particles: where there is room for them, and putting them there.

#include <cstdint>
#include <vector>

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"
#include "clca/lattice/region.hpp"

namespace clca::grains {

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

}  // namespace clca::grains
