// The decisions about particles in a step.

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "automaton/rule/step.hpp"
#include "clca/random/draw.hpp"

namespace clca::automaton {

namespace {

using lattice::Direction;

// Changes that a move would make to the overlaps of a particle.

/// One of those with whom a particle shares sites before a move or after it. No overlap of two
/// particles is deeper than one move.
struct OverlapChange {
  grains::Owner owner = 0;
  int sites_before = 0;
  int sites_after = 0;

  /// What has to shrink: the depth in a particle, the sites shared with a wall.
  int size_before() const {
    return grains::is_particle(owner) ? std::min(sites_before, 1) : sites_before;
  }
  int size_after() const {
    return grains::is_particle(owner) ? std::min(sites_after, 1) : sites_after;
  }
  bool grows() const { return grains::is_particle(owner) && sites_after > sites_before; }
  bool begins() const { return grains::is_particle(owner) && sites_before == 0; }
};

/// The changes by a move of particle `id` that stays inside the box.
std::vector<OverlapChange> overlap_changes(const World& world, std::uint32_t id,
                                           Direction direction) {
  const grains::State& state = world.state;
  const grains::Particle& here = state.particles[id];
  const std::vector<Overlap> before = world.overlaps_at(id, here);
  const std::vector<Overlap> after = world.overlaps_at(id, after_step(here, direction));
  std::vector<OverlapChange> result;
  result.reserve(before.size() + after.size());
  for (const Overlap& overlap : before) {
    result.push_back({.owner = overlap.owner, .sites_before = overlap.shared_sites});
  }
  for (const Overlap& overlap : after) {
    auto change = std::ranges::find(result, overlap.owner, &OverlapChange::owner);
    if (change == result.end()) {
      change = result.insert(result.end(), {.owner = overlap.owner});
    }
    change->sites_after = overlap.shared_sites;
  }
  return result;
}

/// The one that concerns `owner`; null where there is none.
const OverlapChange* find(const std::vector<OverlapChange>& changes, grains::Owner owner) {
  const auto found = std::ranges::find(changes, owner, &OverlapChange::owner);
  return found == changes.end() ? nullptr : &*found;
}

/// Whether a particle that overlaps another one already could not leave it by any move from
/// `there`. Out of an overlap that begins, the way back leads.
bool cannot_leave_overlap(const World& world, const grains::Particle& there,
                          const OverlapChange& change) {
  return grains::is_particle(change.owner) && change.sites_before > 0 && change.sites_after > 0 &&
         !can_leave(world, there, change.owner, lattice::kDirections);
}

/// Sites that a particle shares with other particles.
int shared_sites(const World& world, std::uint32_t id) {
  int sum = 0;
  world.box.for_each_index(world.state.particles[id], [&](std::size_t index) {
    // A wall is the first owner of a site, so this is one only if both are particles.
    const bool two = world.occupancy.second_owner(index) != grains::kFree;
    sum += two && grains::is_particle(world.occupancy.owner(index)) ? 1 : 0;
  });
  return sum;
}

// The passive rule: where a particle goes that something has been pushed onto (Sakaguchi et al.
// 2001, Fig. 8, after Murakami).

// Terms of Assessment::score (from trials with hexagons): penalties are added, bonuses subtracted.
constexpr int kPenaltyPerGrownDepth = 1000;
constexpr int kRelaxedPenalty = 500;
constexpr int kRelaxedOnOthersPenalty = 2000;
constexpr int kBonusPerPushAlong = 60;
constexpr int kKeepsOnBonus = 20;
constexpr int kAlongGravityBonus = 10;
constexpr int kBesideGravityBonus = 5;

/// Radius of the least hexagon with as many sites.
int radius_of(const lattice::Shape& shape) {
  const int sites = static_cast<int>(shape.size());
  int radius = 0;
  while (3 * radius * (radius + 1) + 1 < sites) {
    ++radius;
  }
  return radius;
}

/// Sites that a particle may share with others: 30 % of its sites, at least 2.
int shared_sites_limit(const lattice::Shape& shape) {
  return std::max(2, static_cast<int>((6 * shape.size() + 10) / 20));
}

int gravity_bonus(const Rules& rules, Direction direction) {
  const int sixths = lattice::sixths_between(rules.gravity, direction);
  return sixths == 0 ? kAlongGravityBonus : sixths == 1 ? kBesideGravityBonus : 0;
}

/// How a direction follows the pushes: strictly, or else relaxed.
struct PushAlignment {
  int sixths = 0;        // of a full turn, from the push that is followed least
  int pushes_along = 0;  // pushes exactly in the direction
  bool strict = false;   // within 60 degrees of all pushes, and each of their overlaps shrinks
};
/// The changes by a move in a direction, and its score: the least is the best.
struct Assessment {
  std::vector<OverlapChange> changes;
  int score = 0;
};

const lattice::Shape& shape_of(const World& world, grains::Owner owner) {
  return world.state.shape(world.state.particles[grains::particle_id(owner)]);
}

/// How the direction follows the pushes onto a particle; none: neither strictly nor relaxed.
std::optional<PushAlignment> alignment_with_pushes(const World& world, std::uint32_t id,
                                                   Direction direction,
                                                   const std::vector<OverlapChange>& changes) {
  PushAlignment alignment;
  bool all_shrink = true;
  bool any_shrinks = false;
  for (const grains::Push& push : world.pushes_onto(id)) {
    const OverlapChange* change = find(changes, push.pusher);
    if (change == nullptr || change->size_after() > change->size_before()) {
      return std::nullopt;
    }
    const bool shrinks = change->size_after() < change->size_before();
    all_shrink = all_shrink && shrinks;
    any_shrinks = any_shrinks || shrinks;
    alignment.sixths =
        std::max(alignment.sixths, lattice::sixths_between(push.direction, direction));
    alignment.pushes_along += push.direction == direction ? 1 : 0;
  }
  alignment.strict = alignment.sixths <= 1 && all_shrink;
  return any_shrinks ? std::optional(alignment) : std::nullopt;
}

/// Whether the direction is within 120 degrees of all pushes.
bool follows_pushes(const World& world, std::uint32_t id, Direction direction) {
  const auto pushes = world.pushes_onto(id);
  return std::ranges::all_of(pushes, [&](const grains::Push& push) {
    return lattice::sixths_between(push.direction, direction) <= 2;
  });
}

/// Overlaps that begin, each weighed with the size of the other. None: one would be too deep.
std::optional<int> grown_depth(const World& world, std::uint32_t id, Direction direction,
                               const std::vector<OverlapChange>& changes) {
  const grains::Particle there = after_step(world.state.particles[id], direction);
  int grown = 0;
  for (const OverlapChange& change : changes) {
    if (cannot_leave_overlap(world, there, change)) {
      return std::nullopt;
    }
    grown += change.begins() ? 1 + radius_of(shape_of(world, change.owner)) : 0;
  }
  return grown;
}

/// Whether each site that the particle would enter may have it as one of two owners.
bool has_room(const World& world, std::uint32_t id, Direction direction) {
  const grains::State& state = world.state;
  const grains::Particle& here = state.particles[id];
  bool room = true;
  world.box.for_each_entered(here, direction, [&](std::size_t index) {
    const grains::Owner owner = world.occupancy.owner(index);
    const bool closed =
        owner == grains::kBorder ||
        (grains::is_obstacle(owner) && !state.walls[grains::wall_number(owner)].lets_overlap());
    room = room && !closed && world.occupancy.second_owner(index) == grains::kFree;
  });
  return room;
}

/// Whether the move gets onto no further wall, and shares no more sites with walls than now.
bool keeps_off_walls(const World& world, std::uint32_t id, Direction direction,
                     const std::vector<OverlapChange>& changes) {
  const grains::Particle there = after_step(world.state.particles[id], direction);
  int before = 0;
  int after = 0;
  for (const OverlapChange& change : changes) {
    if (grains::is_particle(change.owner)) {
      continue;
    }
    before += change.sites_before;
    after += change.sites_after;
    // Onto a further wall nobody may go: that would be an overlap without a push.
    const bool comes_onto = change.sites_before == 0;
    if (comes_onto ||
        (change.sites_after > 0 && !can_leave(world, there, change.owner, lattice::kDirections))) {
      return false;
    }
  }
  return after <= before;
}

/// Whether the particle, and each that it enters further, shares no more sites than its limit.
bool is_within_limits(const World& world, std::uint32_t id,
                      const std::vector<OverlapChange>& changes) {
  bool grows = false;
  int own = 0;
  for (const OverlapChange& change : changes) {
    if (!grains::is_particle(change.owner)) {
      continue;
    }
    own += change.sites_after;
    grows = grows || change.grows();
    if (change.grows() && shared_sites(world, grains::particle_id(change.owner)) +
                                  change.sites_after - change.sites_before >
                              shared_sites_limit(shape_of(world, change.owner))) {
      return false;
    }
  }
  return !grows || own <= shared_sites_limit(shape_of(world, grains::as_owner(id)));
}

/// Assesses a direction of a pushed particle: it has to get it out of what pushes it along the way
/// of the push, or at least sideways, without worse elsewhere; it may push others.
std::optional<Assessment> assess(const World& world, std::uint32_t id, Direction direction) {
  if (!follows_pushes(world, id, direction) || !has_room(world, id, direction)) {
    return std::nullopt;
  }
  Assessment assessment{.changes = overlap_changes(world, id, direction), .score = 0};
  const std::optional<PushAlignment> alignment =
      alignment_with_pushes(world, id, direction, assessment.changes);
  if (!alignment || !keeps_off_walls(world, id, direction, assessment.changes)) {
    return std::nullopt;
  }
  const std::optional<int> grown = grown_depth(world, id, direction, assessment.changes);
  if (!grown || (*grown > 0 && alignment->sixths > 1) ||
      !is_within_limits(world, id, assessment.changes)) {
    return std::nullopt;
  }
  const grains::State& state = world.state;
  const bool keeps_on = state.particles[id].previous == static_cast<grains::Move>(direction);
  const int price = alignment->strict ? 0 : *grown == 0 ? kRelaxedPenalty : kRelaxedOnOthersPenalty;
  assessment.score = kPenaltyPerGrownDepth * *grown + price -
                     kBonusPerPushAlong * alignment->pushes_along - (keeps_on ? kKeepsOnBonus : 0) -
                     gravity_bonus(world.rules, direction);
  return assessment;
}

// Of several pushes the move carries on the one it follows best; of equal ones the heaviest.
grains::Push cause(const World& world, std::uint32_t id, Direction direction,
                   const std::vector<OverlapChange>& changes) {
  const auto sites = [&](const grains::Push& push) {
    const OverlapChange* change = find(changes, push.pusher);
    return change == nullptr ? 0 : change->sites_before;
  };
  const auto causes = world.pushes_onto(id);
  return *std::ranges::min_element(causes, {}, [&](const grains::Push& push) {
    return std::pair(lattice::sixths_between(push.direction, direction), -sites(push));
  });
}

/// The best direction of a particle onto which others were pushed; kRest: it is jammed.
grains::Move passive_direction(const World& world, std::uint32_t id) {
  std::vector<Direction> best;
  int least = 0;
  for (const Direction direction : lattice::kDirections) {
    const auto assessment = assess(world, id, direction);
    if (!assessment || (!best.empty() && assessment->score > least)) {
      continue;
    }
    if (best.empty() || assessment->score < least) {
      best.clear();
      least = assessment->score;
    }
    best.push_back(direction);
  }
  if (best.empty()) {
    return grains::kRest;
  }
  const std::uint64_t bits =
      random::draw(world.state.seed, world.state.step, id, random::Purpose::passive);
  return static_cast<grains::Move>(best[random::uniform_below(bits, best.size())]);
}

// All other particles that overlap.

/// A direction and its two neighbours.
std::array<Direction, 3> with_neighbours(Direction first, bool right_first) {
  const int right = right_first ? 1 : -1;
  return {first, rotated(first, right), rotated(first, -right)};
}

/// Whether it may go that way by itself: into free sites, deeper into nobody.
bool is_free(const World& world, std::uint32_t id, Direction direction) {
  if (!world.box.is_free(world.state.particles[id], direction)) {
    return false;
  }
  const std::vector<OverlapChange> all = overlap_changes(world, id, direction);
  const grains::Particle there = after_step(world.state.particles[id], direction);
  return std::ranges::none_of(all, [&](const OverlapChange& change) {
    return change.size_after() > change.size_before() || cannot_leave_overlap(world, there, change);
  });
}

/// The move of a particle that has pushed others of which some rest: back from all of these, within
/// 60 degrees, into free sites; kRest if it cannot. None: it is free to choose.
std::optional<grains::Move> way_back(const World& world, std::uint32_t id) {
  const grains::State& state = world.state;
  std::vector<grains::Push> resting;
  for (const Overlap& overlap : world.overlaps_at(id, state.particles[id])) {
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
  for (const Direction direction :
       with_neighbours(opposite(resting.front().direction), right_first)) {
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

bool can_leave(const World& world, const grains::Particle& particle, grains::Owner owner,
               std::span<const lattice::Direction> directions) {
  const lattice::Lattice& lattice = world.state.lattice;
  return std::ranges::any_of(directions, [&](Direction direction) {
    const grains::Particle target = after_step(particle, direction);
    const std::size_t index = lattice.index(target.site());
    const int column = lattice.wrapped(target.column);
    const std::vector<lattice::IndexOffset>& body = world.box.footprints.footprint(target).covered;
    return std::ranges::none_of(body, [&](lattice::IndexOffset offset) {
      return world.occupancy.has_owner(lattice.shifted_index(index, column, offset), owner);
    });
  });
}

grains::Move provisional_move(const World& world, const ActiveRule& active, std::uint32_t id) {
  // The passive rule, for those that something has been pushed onto.
  if (!world.pushes_onto(id).empty()) {
    return passive_direction(world, id);
  }
  // Back from those that it has pushed itself, where they rest.
  if (const auto back = way_back(world, id)) {
    return *back;
  }
  // Else the active rule.
  return active.provisional_move(
      id, world.state.particles[id].previous, world.state.step,
      [&](Direction direction) { return is_free(world, id, direction); });
}

bool try_move_by_itself(World& world, std::uint32_t id, Direction direction) {
  if (!is_free(world, id, direction)) {
    return false;
  }
  world.move(id, direction);
  return true;
}

bool try_move_pushed(World& world, std::uint32_t id, Direction direction) {
  const auto assessment = assess(world, id, direction);
  if (!assessment) {
    return false;
  }
  const grains::Push push = cause(world, id, direction, assessment->changes);
  world.move(id, direction);
  for (const OverlapChange& change : assessment->changes) {
    if (change.begins()) {
      world.record_push({.pushed = grains::particle_id(change.owner),
                         .pusher = grains::as_owner(id),
                         .source = push.source,
                         .direction = push.direction});
    }
  }
  return true;
}

}  // namespace clca::automaton
