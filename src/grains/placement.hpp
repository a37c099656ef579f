#pragma once
// Placement of single particles.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/lattice/region.hpp"
#include "grains/internal/box.hpp"

namespace clca::grains {

/// True if all sites of the particle are in the box and free.
bool fits(const Box& box, const Particle& particle);

/// True if every site of the particle is in the region.
bool lies_inside(const State& state, const Particle& particle, const lattice::Rectangle& region);

/// Appends the particle, which must fit.
void insert(Box& box, const Particle& particle);

/// The kinds of a species: one for each orientation.
std::vector<std::uint16_t> kinds_of(const State& state, std::size_t species);

/// A species, drawn for the next particle in proportion to the weights, which are not all zero.
std::size_t draw_species(const State& state, std::span<const std::size_t> weights);

/// Renumbers the particles from `first` on, column by column from the left, upwards, so that
/// neighbours in the box are neighbours in memory.
void renumber(Box& box, std::size_t first);

}  // namespace clca::grains
