#pragma once
// Impacts among few grains, solved on their own.

#include <span>

#include "clca/contact/state.hpp"
#include "contact/rule/rule.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

/// Sets `impact` of the contacts and changes the velocities. First the bodies are stopped, by
/// sweeps until the impulses hardly change any more; then the same impulses act again, times the
/// restitution (Poisson's hypothesis with one ratio for the whole impact), or less, so that the
/// kinetic energy does not rise. The contacts do not bounce once more. `contacts`: all of their
/// grains.
void solve_impact(std::span<Touch* const> contacts, const grains::State& grains, const Rule& rule,
                  const VelocityOf& velocity_of);

}  // namespace clca::contact
