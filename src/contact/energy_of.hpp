#pragma once
// Energy of single grains and work in single steps, in units of Energy. `gravity` in lattice
// spacings per step squared.

#include <span>
#include <vector>

#include "clca/contact/energy.hpp"

namespace clca::contact {

/// Of a present grain.
Energy energy_of(const State& state, std::size_t id, double gravity);

/// Positions of the walls along their motions, in lattice spacings: a wall that follows its motion
/// is where that is, one that lags by more than a spacing moves by sites.
std::vector<double> wall_positions(const State& state);

/// Work of walls in the step that led to `state`: impulses times displacements. `contacts`: those
/// with walls, others do not count; `before`: wall_positions.
double wall_work(const State& state, std::span<const Contact> contacts,
                 const std::vector<double>& before, double gravity);

/// Work of the vessel in the step that led to `state`; `before`: the vessel as it began.
double vessel_work(const State& state, const Vessel& before, double gravity);

}  // namespace clca::contact
