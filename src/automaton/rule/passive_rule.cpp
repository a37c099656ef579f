#include "automaton/rule/passive_rule.hpp"

#include <algorithm>

#include "clca/random/draw.hpp"

namespace clca::automaton {

namespace {

using lattice::Direction;

// What counts in a choice, by weight (from trials with hexagons).
constexpr int kPerGrownDepth = 1000;
constexpr int kRelaxed = 500;
constexpr int kRelaxedOnOthers = 2000;
constexpr int kPerPushAlong = 60;
constexpr int kKeepsOn = 20;
constexpr int kAlongGravity = 10;
constexpr int kBesideGravity = 5;

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
int limit(const lattice::Shape& shape) {
  return std::max(2, static_cast<int>((6 * shape.size() + 10) / 20));
}

int gravity_bonus(const Rules& rules, Direction direction) {
  const int turns = lattice::turns_between(rules.gravity, direction);
  return turns == 0 ? kAlongGravity : turns == 1 ? kBesideGravity : 0;
}

}  // namespace

grains::Move PassiveRule::provisional(std::uint32_t id) {
  std::vector<Direction> best;
  int least = 0;
  for (const Direction direction : lattice::kDirections) {
    const auto judgement = judge(id, direction);
    if (!judgement || (!best.empty() && judgement->score > least)) {
      continue;
    }
    if (best.empty() || judgement->score < least) {
      best.clear();
      least = judgement->score;
    }
    best.push_back(direction);
  }
  if (best.empty()) {
    return grains::kRest;
  }
  const std::uint64_t bits =
      random::draw(world_.state.seed, world_.state.step, id, random::Purpose::passive);
  return static_cast<grains::Move>(best[random::below(bits, best.size())]);
}

bool PassiveRule::move(std::uint32_t id, Direction direction) {
  const auto judgement = judge(id, direction);
  if (!judgement) {
    return false;
  }
  const grains::Push push = cause(id, direction, judgement->changes);
  world_.move(id, direction);
  record(id, push, judgement->changes);
  return true;
}

std::optional<PassiveRule::Judgement> PassiveRule::judge(std::uint32_t id, Direction direction) {
  if (!follows_pushes(id, direction) || !has_room(id, direction)) {
    return std::nullopt;
  }
  Judgement judgement{.changes = overlap_changes(world_, id, direction), .score = 0};
  const std::optional<Following> following = following_of(id, direction, judgement.changes);
  if (!following || !keeps_off_walls(id, direction, judgement.changes)) {
    return std::nullopt;
  }
  const std::optional<int> grown = grown_depth(id, direction, judgement.changes);
  if (!grown || (*grown > 0 && following->turns > 1) || !is_within_limits(id, judgement.changes)) {
    return std::nullopt;
  }
  const grains::State& state = world_.state;
  const bool keeps_on = state.particles[id].previous == static_cast<grains::Move>(direction);
  const int price = following->strict ? 0 : *grown == 0 ? kRelaxed : kRelaxedOnOthers;
  judgement.score = kPerGrownDepth * *grown + price - kPerPushAlong * following->pushes_along -
                    (keeps_on ? kKeepsOn : 0) - gravity_bonus(world_.rules, direction);
  return judgement;
}

std::optional<PassiveRule::Following> PassiveRule::following_of(
    std::uint32_t id, Direction direction, const std::vector<OverlapChange>& changes) const {
  Following following;
  bool all_shrink = true;
  bool any_shrinks = false;
  for (const grains::Push& push : PushList::onto(world_.state, id)) {
    const OverlapChange* change = find(changes, push.pusher);
    if (change == nullptr || change->after() > change->before()) {
      return std::nullopt;
    }
    const bool shrinks = change->after() < change->before();
    all_shrink = all_shrink && shrinks;
    any_shrinks = any_shrinks || shrinks;
    following.turns = std::max(following.turns, lattice::turns_between(push.direction, direction));
    following.pushes_along += push.direction == direction ? 1 : 0;
  }
  following.strict = following.turns <= 1 && all_shrink;
  return any_shrinks ? std::optional(following) : std::nullopt;
}

bool PassiveRule::follows_pushes(std::uint32_t id, Direction direction) const {
  const auto pushes = PushList::onto(world_.state, id);
  return std::all_of(pushes.begin(), pushes.end(), [&](const grains::Push& push) {
    return lattice::turns_between(push.direction, direction) <= 2;
  });
}

std::optional<int> PassiveRule::grown_depth(std::uint32_t id, Direction direction,
                                            const std::vector<OverlapChange>& changes) const {
  const grains::Particle there = moved(world_.state.particles[id], direction);
  int grown = 0;
  for (const OverlapChange& change : changes) {
    if (is_too_deep(world_, there, change)) {
      return std::nullopt;
    }
    grown += change.begins() ? 1 + radius_of(shape_of(change.owner)) : 0;
  }
  return grown;
}

bool PassiveRule::has_room(std::uint32_t id, Direction direction) const {
  const grains::State& state = world_.state;
  const grains::Particle& here = state.particles[id];
  bool room = true;
  world_.box.for_each_index(
      here, world_.box.footprints.of(here).lead[index_of(direction)], [&](std::size_t index) {
        const grains::Owner owner = world_.occupancy.owner(index);
        const bool closed =
            owner == grains::kBorder ||
            (grains::is_wall(owner) && !state.walls[grains::wall_number(owner)].lets_overlap());
        room = room && !closed && world_.occupancy.second_owner(index) == grains::kFree;
      });
  return room;
}

bool PassiveRule::keeps_off_walls(std::uint32_t id, Direction direction,
                                  const std::vector<OverlapChange>& changes) const {
  const grains::Particle there = moved(world_.state.particles[id], direction);
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
        (change.sites_after > 0 && !can_leave(world_, there, change.owner, lattice::kDirections))) {
      return false;
    }
  }
  return after <= before;
}

bool PassiveRule::is_within_limits(std::uint32_t id,
                                   const std::vector<OverlapChange>& changes) const {
  bool grows = false;
  int own = 0;
  for (const OverlapChange& change : changes) {
    if (!grains::is_particle(change.owner)) {
      continue;
    }
    own += change.sites_after;
    grows = grows || change.grows();
    if (change.grows() && shared_sites(world_, grains::particle_id(change.owner)) +
                                  change.sites_after - change.sites_before >
                              limit(shape_of(change.owner))) {
      return false;
    }
  }
  return !grows || own <= limit(shape_of(grains::as_owner(id)));
}

// Of several pushes the move carries on the one it follows best; of equal ones the heaviest.
grains::Push PassiveRule::cause(std::uint32_t id, Direction direction,
                                const std::vector<OverlapChange>& changes) const {
  const auto sites = [&](const grains::Push& push) {
    const OverlapChange* change = find(changes, push.pusher);
    return change == nullptr ? 0 : change->sites_before;
  };
  const auto causes = PushList::onto(world_.state, id);
  return *std::min_element(
      causes.begin(), causes.end(), [&](const grains::Push& a, const grains::Push& b) {
        return std::pair(lattice::turns_between(a.direction, direction), -sites(a)) <
               std::pair(lattice::turns_between(b.direction, direction), -sites(b));
      });
}

void PassiveRule::record(std::uint32_t id, const grains::Push& cause,
                         const std::vector<OverlapChange>& changes) {
  for (const OverlapChange& change : changes) {
    if (change.begins()) {
      world_.pushes.record(world_.state, {.pushed = grains::particle_id(change.owner),
                                          .pusher = grains::as_owner(id),
                                          .source = cause.source,
                                          .direction = cause.direction});
    }
  }
}

}  // namespace clca::automaton
