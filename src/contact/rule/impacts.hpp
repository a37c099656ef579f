#pragma once
// Impacts among few grains, solved on their own.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/rule.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

/// An impact is solved on its own if the grains that it reaches through contacts are at most so
/// many. Otherwise the sweeps of the step solve it with everything else.
inline constexpr std::size_t kMostGrains = 8;

/// The contacts of each impact that is solved on its own, in their order.
std::vector<std::vector<Touch*>> isolated_impacts(std::span<Touch> contacts, std::size_t grains);

/// Sets `impact` of the contacts and changes the velocities. First the bodies are stopped, by
/// sweeps until the impulses hardly change any more; then the same impulses act again, times the
/// restitution (Poisson's hypothesis with one ratio for the whole impact), or less, so that the
/// kinetic energy does not rise. The contacts do not bounce once more. `contacts`: all of their
/// grains.
void solve_impact(std::span<Touch* const> contacts, const grains::State& grains, const Rule& rule,
                  const VelocityOf& velocity_of);

}  // namespace clca::contact
