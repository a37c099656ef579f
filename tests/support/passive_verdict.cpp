#include "support/passive_verdict.hpp"

#include <algorithm>

namespace clca::testing {

using grains::is_particle;
using grains::is_wall;
using grains::Move;
using grains::Owner;
using grains::Particle;
using grains::Push;
using lattice::Direction;
using lattice::Site;

namespace {

int least_radius(std::size_t sites) {
  for (int radius = 0;; ++radius) {
    if (lattice::Shape::hexagon(radius).size() >= sites) {
      return radius;
    }
  }
}

}  // namespace

Verdict::Verdict(const Crowd& crowd, Direction gravity, Owner id, Direction direction)
    : crowd_(crowd),
      gravity_(gravity),
      id_(id),
      direction_(direction),
      changes_(crowd.changes(id, direction)),
      pushes_(crowd.pushes_onto(id)) {
  for (const auto& [other, change] : changes_) {
    if (is_particle(other) && change.depth_after > change.depth_before) {
      deepened_.insert(other);
    }
  }
}

std::optional<int> Verdict::score() const {
  const bool admissible = has_room() && minds_walls() && bearable();
  const bool strict = helps_strictly();
  if (!admissible || !(strict || helps_somehow()) || (!deepened_.empty() && angle() > 1)) {
    return std::nullopt;
  }
  const int turns = lattice::turns_between(gravity_, direction_);
  const int relaxed = deepened_.empty() ? 500 : 2000;
  const bool keeps = crowd_.particle(id_).previous == static_cast<Move>(direction_);
  return 1000 * grown() + (strict ? 0 : relaxed) - 60 * votes() - (keeps ? 20 : 0) -
         (turns == 0 ? 10 : 0) - (turns == 1 ? 5 : 0);
}

int Verdict::grown() const {
  int sum = 0;
  for (const Owner other : deepened_) {
    const std::size_t size = crowd_.state().shape(crowd_.particle(other)).size();
    sum += changes_.at(other).depth_after * (1 + least_radius(size));
  }
  return sum;
}

int Verdict::votes() const {
  return static_cast<int>(std::count_if(pushes_.begin(), pushes_.end(), [&](const Push& push) {
    return push.direction == direction_;
  }));
}

std::vector<Push> Verdict::new_pushes() const {
  const Push* cause = &pushes_.front();
  for (const Push& push : pushes_) {
    const int nearer = lattice::turns_between(cause->direction, direction_) -
                       lattice::turns_between(push.direction, direction_);
    const int heavier =
        changes_.at(push.pusher).sites_before - changes_.at(cause->pusher).sites_before;
    if (nearer > 0 || (nearer == 0 && heavier > 0)) {
      cause = &push;
    }
  }
  std::vector<Push> result;
  for (const Owner other : deepened_) {
    result.push_back({.pushed = static_cast<std::uint32_t>(other),
                      .pusher = id_,
                      .source = cause->source,
                      .direction = cause->direction});
  }
  return result;
}

/// From the push that is followed least, in turns by 60 degrees.

int Verdict::angle() const {
  int most = 0;
  for (const Push& push : pushes_) {
    most = std::max(most, lattice::turns_between(push.direction, direction_));
  }
  return most;
}

/// How much less it overlaps with a pusher.
int Verdict::relief(const Push& push) const {
  const Change& change = changes_.at(push.pusher);
  return is_wall(push.pusher) ? change.sites_before - change.sites_after
                              : change.depth_before - change.depth_after;
}

bool Verdict::helps_strictly() const {
  return !pushes_.empty() && angle() <= 1 &&
         std::all_of(pushes_.begin(), pushes_.end(),
                     [&](const Push& push) { return relief(push) > 0; });
}

bool Verdict::helps_somehow() const {
  return angle() <= 2 &&
         std::all_of(pushes_.begin(), pushes_.end(),
                     [&](const Push& push) { return relief(push) >= 0; }) &&
         std::any_of(pushes_.begin(), pushes_.end(),
                     [&](const Push& push) { return relief(push) > 0; });
}

bool Verdict::has_room() const {
  const Sites ahead = crowd_.lead(id_, direction_);
  return inside(crowd_.state(), ahead) && std::none_of(ahead.begin(), ahead.end(), [&](Site site) {
           const std::set<Owner> owners = crowd_.owners(site);
           return owners.size() > 1 || std::any_of(owners.begin(), owners.end(), [&](Owner owner) {
                    return is_wall(owner) &&
                           !crowd_.state().walls[grains::wall_number(owner)].lets_overlap();
                  });
         });
}

bool Verdict::minds_walls() const {
  int sum = 0;
  bool all_can_be_left = true;
  for (const auto& [other, change] : changes_) {
    if (is_wall(other)) {
      sum += change.sites_after - change.sites_before;
      all_can_be_left = all_can_be_left && change.sites_before > 0 &&
                        (change.sites_after == 0 || can_leave_then(other));
    }
  }
  return sum <= 0 && all_can_be_left;
}

bool Verdict::can_leave_then(Owner wall) const {
  Particle there = crowd_.particle(id_);
  const Site target = there.site() + unit(direction_);
  there.column = target.column;
  there.row = target.row;
  const auto& ways = lattice::kDirections;
  return std::any_of(ways.begin(), ways.end(), [&](Direction way) {
    return shared(body_after(crowd_.state(), there, way), body_of(crowd_.state(), wall)) == 0;
  });
}

bool Verdict::bearable() const {
  int own = 0;
  bool any_grows = false;
  bool others_bear = true;
  for (const auto& [other, change] : changes_) {
    if (!is_particle(other)) {
      continue;
    }
    own += change.sites_after;
    const bool grows = change.sites_after > change.sites_before;
    const int its = crowd_.burden(other) + change.sites_after - change.sites_before;
    any_grows = any_grows || grows;
    others_bear = others_bear && (!grows || its <= crowd_.limit(other)) &&
                  (change.depth_after <= 1 || change.depth_after <= change.depth_before);
  }
  return others_bear && (!any_grows || own <= crowd_.limit(id_));
}

}  // namespace clca::testing
