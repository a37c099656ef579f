#pragma once
// The exact scheme: pairs in continuous time.

#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann {

/// As advance(), by the scheme Majorant.
///
/// A step lasts about one collision per particle. In it the particles are cut into groups (see
/// Grouping), pairs collide within their group only, and velocities change by shear half before and
/// half after. Particles meet within a group more often than they should, by a share of the order
/// of 1 / (group size): less than the noise of a run of that size.
void advance_majorant(Gas& gas, const Law& law, double shear_rate, std::uint64_t seed, double time,
                      int threads, const KeepsOn& keeps_on);

}  // namespace clca::boltzmann
