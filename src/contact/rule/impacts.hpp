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

/// A contact of grains that an impact reaches.
struct ImpactContact {
  std::size_t at = 0;       ///< its place in the list of contacts
  Contact contact = {};     ///< its `impact` is what solve_impact() sets
  std::int32_t bounce = 0;  ///< the velocity with which its bodies are to separate
};

/// The contacts of each impact that is solved on its own, in their order. `bounces`: by contact.
std::vector<std::vector<ImpactContact>> isolated_impacts(std::span<const Touch> contacts,
                                                         std::span<const std::int32_t> bounces,
                                                         std::size_t grains);

/// Sets the impulses of an impact and changes the velocities, by sweeps until the impulses hardly
/// change any more. `contacts`: all contacts of their grains.
void solve_impact(std::span<ImpactContact> contacts, const grains::State& grains, const Rule& rule,
                  const VelocityOf& velocity_of);

}  // namespace clca::contact
