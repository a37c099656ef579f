#include "contact/rule/cuts.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "contact/rule/remainders.hpp"

namespace clca::contact {

namespace {

/// A grain whose remainder is cut, and what is in its way.
struct Push {
  std::uint32_t id = 0;
  grains::Owner other = 0;
  lattice::Direction direction = {};
};

/// How many pushes a grain takes part in, and the sum of their impulses on it.
struct PushSum {
  std::uint32_t id = 0;
  std::int64_t pushes = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
};

std::int32_t inverse_mass(const State& state, const Rule& rule, std::uint32_t id) {
  return rule.bodies.pair(state.grains.particles[id].kind, std::nullopt).upper_inverse_mass;
}

/// Of the grains that take part in pushes.
class PushSums {
 public:
  explicit PushSums(std::size_t grains) : number_(grains, 0) {}

  /// Counts one more push of a grain.
  void add(std::uint32_t id) {
    if (number_[id] == 0) {
      sums_.push_back({.id = id});
      number_[id] = static_cast<std::uint32_t>(sums_.size());
    }
    ++of(id).pushes;
  }
  /// Of a grain that has been added.
  PushSum& of(std::uint32_t id) { return sums_[number_[id] - 1]; }
  const std::vector<PushSum>& all() const { return sums_; }

 private:
  std::vector<std::uint32_t> number_;  // by id: in sums_, from 1
  std::vector<PushSum> sums_;
};

/// Takes from a velocity along a direction what a grain that has free sites in its way was too fast
/// to move. Returns whether it was: slower than a site a step it can move later.
bool slow_down(Velocity<std::int32_t>& velocity, std::int32_t excess,
               lattice::Direction direction) {
  const auto towards = [&](lattice::Direction way) {
    return along({velocity.x, velocity.y}, unit_of(way));
  };
  const std::int32_t speed = towards(direction);
  if (speed <= kSpacing ||
      std::any_of(lattice::kDirections.begin(), lattice::kDirections.end(),
                  [&](lattice::Direction other) { return towards(other) > speed; })) {
    return false;  // or its velocity is that of another direction
  }
  Vector slower = {velocity.x, velocity.y};
  take(slower, std::min(excess, speed - kSpacing), direction);
  velocity.x = slower.x;
  velocity.y = slower.y;
  return true;
}

/// Cuts the remainder of a grain and calls `visit` with each direction in which it was too long,
/// and by how much.
template <class Visit>
void cut(Vector& remainder, Visit visit) {
  // Fitted. With 3/4 of a site, dense flow would lose too much of its distance.
  constexpr std::int32_t kMost = 2 * kSpacing;
  if (squared(remainder) <= product(kMost, kMost)) {
    return;  // so are nearly all
  }
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::int32_t excess = along(remainder, unit_of(direction)) - kMost;
    if (excess > 0) {
      take(remainder, excess, direction);
      visit(direction, excess);
    }
  }
}

}  // namespace

Cuts cut_remainders(State& state, const SiteMoves& moves, const Rule& rule,
                    std::span<const std::uint32_t> ids, const VelocityOf& velocity_of) {
  Cuts result;
  std::vector<Push> pushes;
  for (const std::uint32_t id : ids) {
    cut(state.remainders[id], [&](lattice::Direction direction, std::int32_t excess) {
      const grains::Owner other = moves.in_the_way(id, direction);
      if (other != grains::kFree) {
        pushes.push_back({.id = id, .other = other, .direction = direction});
      } else if (slow_down(velocity_of(grains::as_owner(id)), excess, direction)) {
        result.too_fast = true;
      }
    });
  }
  const auto closing = [&](const Push& push) {
    const Velocity<std::int32_t>& own = velocity_of(grains::as_owner(push.id));
    const Velocity<std::int32_t>& its = velocity_of(push.other);
    return along({own.x - its.x, own.y - its.y}, unit_of(push.direction));
  };
  std::erase_if(pushes, [&](const Push& push) { return closing(push) <= 0; });
  std::sort(pushes.begin(), pushes.end(), [](const Push& one, const Push& other) {
    return std::tie(one.id, one.direction) < std::tie(other.id, other.direction);
  });
  PushSums sums(state.grains.particles.size());
  for (const Push& push : pushes) {
    sums.add(push.id);
    if (grains::is_particle(push.other)) {
      sums.add(grains::particle_id(push.other));
    }
  }
  for (const Push& push : pushes) {
    PushSum& own = sums.of(push.id);
    std::int64_t inverse = own.pushes * inverse_mass(state, rule, push.id);
    PushSum* its = nullptr;
    if (grains::is_particle(push.other)) {
      const std::uint32_t other = grains::particle_id(push.other);
      its = &sums.of(other);
      inverse += its->pushes * inverse_mass(state, rule, other);
    }
    const auto impulse =
        clamped((std::int64_t{closing(push)} << kInverseMassBits) / inverse, 0, kMaxImpulse);
    const UnitVector& unit = unit_of(push.direction);
    result.pushes.push_back({.upper = push.id,
                             .other = push.other,
                             .normal = {-unit.x, -unit.y},
                             .impact = {.normal = impulse}});
    const std::int32_t x = rounded(product(impulse, unit.x), kUnitBits);
    const std::int32_t y = rounded(product(impulse, unit.y), kUnitBits);
    own.x -= x;
    own.y -= y;
    if (its != nullptr) {
      its->x += x;
      its->y += y;
    }
  }
  for (const PushSum& sum : sums.all()) {
    Velocity<std::int32_t>& velocity = velocity_of(grains::as_owner(sum.id));
    const auto changed = [inverse = inverse_mass(state, rule, sum.id)](std::int32_t value,
                                                                       std::int64_t impulse) {
      const std::int32_t most = clamped(impulse, -2 * kMaxImpulse, 2 * kMaxImpulse - 1);
      return clamped(value + limited(product(most, inverse), kInverseMassBits, 2 * kMaxVelocity),
                     -kMaxVelocity, kMaxVelocity);
    };
    velocity.x = changed(velocity.x, sum.x);
    velocity.y = changed(velocity.y, sum.y);
  }
  return result;
}

}  // namespace clca::contact
