#pragma once
// Cuts of remainders: what a grain that is held up loses in distance, it passes on as momentum.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/rule/moves.hpp"
#include "contact/rule/rule.hpp"

namespace clca::contact {

/// What grains exchange where their remainders are cut.
struct Cuts {
  /// Grains and what is in their ways; `impact` is the impulse, along a direction of the lattice.
  /// A pair may push in several directions, and either may be `upper`.
  std::vector<Contact> pushes = {};
  bool too_fast = false;  ///< a grain was faster than it can move
};

/// Shortens remainders to two spacings along any direction. Where a remainder is cut and the grain
/// approaches what is in its way, the two collide along that direction, without restitution and
/// friction: with several such collisions of a body each gets a share of its mass, so that the
/// order does not matter, momentum is conserved, and no energy is gained. Where nothing is in the
/// way, the grain is faster than it can move: it loses velocity with the distance. `ids`: grains
/// whose remainders may be that long, each once, in any order.
Cuts cut_remainders(State& state, const SiteMoves& moves, const Rule& rule,
                    std::span<const std::uint32_t> ids, const VelocityOf& velocity_of);

}  // namespace clca::contact
