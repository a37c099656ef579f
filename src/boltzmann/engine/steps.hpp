#pragma once
// Functions that take one step of a scheme at each call, at most to `time`.

#include <cstdint>
#include <functional>

#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann {

/// Pairs in continuous time: a step lasts about four collisions per particle, under shear at most a
/// fifth. Particles are divided into groups (see Grouping), pairs collide within their group, and
/// shear acts half before and half after.
/// Grouping lets pairs meet again too soon, an error of order 1 / (group size): <v^2> at time 5
/// is 5.9 % too large for groups of 32, 1.0 % for 128, 0.3 % for 512 (restitution 0.5, friction
/// 0.3), so about 0.02 % for 8192 as used here.
std::function<void()> majorant_stepper(Gas& gas, const Law& law, double shear_rate,
                                       std::uint64_t seed, double time, int threads);

/// Whole steps and a shorter last one. All particles read the state before the step, so that the
/// result does not depend on `threads`. With `scheme.quasi` the particles are reordered.
std::function<void()> ogawa_kato_stepper(Gas& gas, const Law& law, const OgawaKato& scheme,
                                         std::uint64_t seed, double time, int threads);

}  // namespace clca::boltzmann
