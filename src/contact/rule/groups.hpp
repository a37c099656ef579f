#pragma once
// Groups of few grains, in which contacts are solved until nothing changes any more.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/rule.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

/// A group of grains that contacts connect is small if it has at most so many; walls connect none.
inline constexpr std::size_t kMostGrains = 8;

/// The contacts of each small group with one that carries or bounces, in their order.
std::vector<std::vector<Touch*>> active_groups(std::span<Touch> contacts, std::size_t grains);

/// Sweeps over contacts, forwards and backwards in turn, until their impulses hardly change any
/// more. `impulse`: which of the contacts, with the velocities as it has made them.
void converge(std::span<Touch* const> contacts, Impulse<std::int32_t> Contact::*impulse,
              const grains::State& grains, const Rule& rule, const VelocityOf& velocity_of);

/// The same for what the sweeps of the step have left. It is added to `impact`: the next step
/// begins with the impulses of the sweeps alone, which stay soft where the group becomes part of a
/// bed.
void finish(std::span<Touch* const> contacts, const grains::State& grains, const Rule& rule,
            const VelocityOf& velocity_of);

}  // namespace clca::contact
