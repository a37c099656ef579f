#include "automaton/rule/retreat.hpp"

#include <algorithm>
#include <array>

#include "automaton/rule/overlap_change.hpp"
#include "clca/random/draw.hpp"

namespace clca::automaton {

namespace {

/// A direction and its two neighbours.
std::array<lattice::Direction, 3> around(lattice::Direction first, bool right_first) {
  const int right = right_first ? 1 : -1;
  return {first, rotated(first, right), rotated(first, -right)};
}

}  // namespace

bool is_free(World& world, std::uint32_t id, lattice::Direction direction) {
  if (!world.is_free(world.state.particles[id], direction)) {
    return false;
  }
  const std::vector<OverlapChange> all = overlap_changes(world, id, direction);
  const grains::Particle there = moved(world.state.particles[id], direction);
  return std::none_of(all.begin(), all.end(), [&](const OverlapChange& change) {
    return change.after() > change.before() || is_too_deep(world, there, change);
  });
}

std::optional<grains::Move> retreat(World& world, std::uint32_t id) {
  const grains::State& state = world.state;
  std::vector<grains::Push> resting;
  for (const Overlap& overlap : world.overlaps(id, state.particles[id])) {
    const auto other = grains::particle_id(overlap.owner);
    const grains::Push* push = grains::is_particle(overlap.owner)
                                   ? find_push(state, other, grains::as_owner(id))
                                   : nullptr;
    if (push != nullptr && state.particles[other].previous == grains::kRest) {
      resting.push_back(*push);
    }
  }
  if (resting.empty()) {
    return std::nullopt;
  }
  const bool right_first =
      (random::draw(state.seed, state.step, id, random::Purpose::passive) & 1U) != 0;
  for (const lattice::Direction direction :
       around(opposite(resting.front().direction), right_first)) {
    const bool back = std::all_of(resting.begin(), resting.end(), [&](const grains::Push& push) {
      return lattice::turns_between(opposite(push.direction), direction) <= 1;
    });
    if (!back || !is_free(world, id, direction)) {
      continue;
    }
    const std::vector<OverlapChange> all = overlap_changes(world, id, direction);
    const bool shrinks = std::all_of(resting.begin(), resting.end(), [&](const grains::Push& push) {
      const OverlapChange* change = find(all, grains::as_owner(push.pushed));
      return change != nullptr && change->sites_after < change->sites_before;
    });
    if (shrinks) {
      return static_cast<grains::Move>(direction);
    }
  }
  return grains::kRest;
}

}  // namespace clca::automaton
