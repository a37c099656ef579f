#include "automaton/rule/decisions.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "automaton/rule/overlap_change.hpp"
#include "automaton/rule/passive_rule.hpp"
#include "clca/random/draw.hpp"

namespace clca::automaton {

namespace {

/// A direction and its two neighbours.
std::array<lattice::Direction, 3> around(lattice::Direction first, bool right_first) {
  const int right = right_first ? 1 : -1;
  return {first, rotated(first, right), rotated(first, -right)};
}

/// Whether it may go that way by itself: into free sites, deeper into nobody.
bool is_free(const World& world, std::uint32_t id, lattice::Direction direction) {
  if (!world.box.is_free(world.state.particles[id], direction)) {
    return false;
  }
  const std::vector<OverlapChange> all = overlap_changes(world, id, direction);
  const grains::Particle there = moved(world.state.particles[id], direction);
  return std::ranges::none_of(all, [&](const OverlapChange& change) {
    return change.after() > change.before() || is_too_deep(world, there, change);
  });
}

/// Where a particle goes that has pushed others, some of which rest: back from all of those,
/// within 60 degrees, into free sites; kRest when it cannot. None: no such partner rests, it may go
/// as it likes.
std::optional<grains::Move> move_back(const World& world, std::uint32_t id) {
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
    const bool back = std::ranges::all_of(resting, [&](const grains::Push& push) {
      return lattice::sixths_between(opposite(push.direction), direction) <= 1;
    });
    if (!back || !is_free(world, id, direction)) {
      continue;
    }
    const std::vector<OverlapChange> all = overlap_changes(world, id, direction);
    const bool shrinks = std::ranges::all_of(resting, [&](const grains::Push& push) {
      const OverlapChange* change = find(all, grains::as_owner(push.pushed));
      return change != nullptr && change->sites_after < change->sites_before;
    });
    if (shrinks) {
      return static_cast<grains::Move>(direction);
    }
  }
  return grains::kRest;
}

}  // namespace

grains::Move provisional(const World& world, const ActiveRule& active, std::uint32_t id) {
  // The passive rule, for those that something has been pushed onto.
  if (!PushList::onto(world.state, id).empty()) {
    return passive_direction(world, id);
  }
  // Back from those that it has pushed itself, where they rest.
  if (const auto back = move_back(world, id)) {
    return *back;
  }
  // Else the active rule.
  return active.provisional(
      id, world.state.particles[id].previous, world.state.step,
      [&](lattice::Direction direction) { return is_free(world, id, direction); });
}

bool move_by_itself(World& world, std::uint32_t id, lattice::Direction direction) {
  if (!is_free(world, id, direction)) {
    return false;
  }
  world.move(id, direction);
  return true;
}

}  // namespace clca::automaton
