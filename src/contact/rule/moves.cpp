#include "contact/rule/moves.hpp"

#include <cstdlib>
#include <map>
#include <utility>

#include "clca/random/draw.hpp"

namespace clca::contact {

using lattice::Direction;

std::array<Direction, lattice::kDirectionCount> direction_order(const grains::State& state,
                                                                Direction down) {
  const std::uint64_t coins =
      random::draw(state.seed, state.step, 0, random::Purpose::direction_order);
  const auto turned = [down](int sixths) { return lattice::rotated(down, sixths); };
  std::array<Direction, lattice::kDirectionCount> order = {down,       turned(-1), turned(1),
                                                           turned(-2), turned(2),  turned(3)};
  if ((coins & 1U) != 0) {
    std::swap(order[1], order[2]);
  }
  if ((coins & 2U) != 0) {
    std::swap(order[3], order[4]);
  }
  return order;
}

void SiteMoves::begin_step() {
  moved_.clear();
  beside_walls_.clear();
  anchor_moved_ = false;
}

template <class Chosen>
grains::Owner SiteMoves::blocking_owner(std::uint32_t id, Direction direction,
                                        Chosen chosen) const {
  const grains::Particle& grain = state_.grains.particles[id];
  const lattice::Lattice& lattice = state_.grains.lattice;
  const std::size_t index = lattice.index(grain.site());
  const int column = lattice.wrapped(grain.column);
  for (const lattice::IndexOffset offset :
       box_.footprints.footprint(grain).lead_sites[lattice::index_of(direction)]) {
    const grains::Owner owner = box_.occupancy.owner(lattice.shifted_index(index, column, offset));
    if (owner != grains::kFree && chosen(owner)) {
      return owner;
    }
  }
  return grains::kFree;
}

grains::Owner SiteMoves::blocking_owner(std::uint32_t id, Direction direction) const {
  return blocking_owner(id, direction, [](grains::Owner /*any*/) { return true; });
}

std::vector<std::uint32_t> SiteMoves::movable_at_once(std::vector<std::uint32_t> blocked,
                                                      Direction direction) const {
  std::ranges::sort(blocked);
  for (std::vector<std::uint32_t> before; before.size() != blocked.size();) {
    before = blocked;
    std::erase_if(blocked, [&](std::uint32_t id) {
      return blocking_owner(id, direction, [&](grains::Owner owner) {
               return !grains::is_particle(owner) ||
                      !std::binary_search(before.begin(), before.end(), grains::particle_id(owner));
             }) != grains::kFree;
    });
  }
  return blocked;
}

void SiteMoves::move(std::span<const std::uint32_t> ids, Direction direction) {
  for (const std::uint32_t id : ids) {
    box_.for_each_vacated(state_.grains.particles[id], direction,
                          [&](std::size_t index) { box_.occupancy.release(index); });
  }
  for (const std::uint32_t id : ids) {
    grains::Particle& grain = state_.grains.particles[id];
    box_.for_each_entered(grain, direction, [&](std::size_t index) {
      box_.occupancy.take(index, grains::as_owner(id));
    });
    grain = grains::after_step(grain, direction);
    if (grain.previous == grains::kRest) {
      moved_.push_back(id);
    }
    grain.previous = static_cast<grains::Move>(direction);
    subtract_along(state_.remainders[id], kSpacing, direction);
    lattice::Axial& from_anchor = state_.from_anchors[id];
    from_anchor = from_anchor + unit(direction);
    if (length_in_steps(from_anchor) > 1) {
      from_anchor = {};
      anchor_moved_ = true;
    }
  }
}

bool SiteMoves::move_walls(Direction direction, std::span<WallMove> walls,
                           std::vector<std::uint32_t>& pushed) {
  bool any = false;
  for (WallMove& wall : walls) {
    if (wall.desired != 0 && !wall.done && wall.direction(state_.grains) == direction) {
      wall.done =
          push_grains(box_.wall_edges.wall_step(state_.grains, wall.wall, wall.desired), pushed);
      any = any || wall.done;
    }
  }
  return any;
}

bool SiteMoves::push_grains(const grains::WallStep& step, std::vector<std::uint32_t>& pushed) {
  const auto ids = grains::pushed_particles(box_, step);
  if (!ids) {
    return false;
  }
  for (const std::size_t index : step.vacated) {
    box_.occupancy.release(index);
  }
  move(*ids, step.direction);
  for (const std::uint32_t id : *ids) {  // at most half a site behind its site
    Vector& remainder = state_.remainders[id];
    subtract_along(remainder,
                   std::min(along(remainder, unit_vector(step.direction)) + kSpacing / 2, 0),
                   step.direction);
  }
  for (const std::size_t index : step.entered) {
    box_.occupancy.take(index, grains::wall_code(step.wall));
  }
  note_neighbours(step.entered);
  note_neighbours(step.vacated);
  pushed.insert(pushed.end(), ids->begin(), ids->end());
  return true;
}

void SiteMoves::note_neighbours(const std::vector<std::size_t>& indices) {
  const lattice::Lattice& lattice = state_.grains.lattice;
  for (const std::size_t index : indices) {
    for (const Direction direction : lattice::kDirections) {
      const grains::Owner owner =
          box_.occupancy.owner(lattice.index(lattice.site(index) + unit(direction)));
      if (grains::is_particle(owner)) {
        beside_walls_.push_back(grains::particle_id(owner));
      }
    }
  }
}

void move_all(SiteMoves& moves, State& state, Direction down, std::span<WallMove> walls) {
  const auto& grains = state.grains.particles;
  for (const Direction direction : direction_order(state.grains, down)) {
    std::vector<bool> moved(grains.size(), false);
    const auto due = [&] {
      std::vector<std::uint32_t> ids;
      for (std::uint32_t id = 0; id < grains.size(); ++id) {
        if (grains[id].present && !moved[id] && is_move_due(state.remainders[id], direction)) {
          ids.push_back(id);
        }
      }
      return ids;
    };
    const auto mark = [&](std::span<const std::uint32_t> ids) {
      for (const std::uint32_t id : ids) {
        moved[id] = true;
      }
      return !ids.empty();
    };
    const auto move_grains = [&] {
      std::vector<std::uint32_t> ids = due();
      std::erase_if(ids, [&](std::uint32_t id) {
        return moves.blocking_owner(id, direction) != grains::kFree;
      });
      moves.move(ids, direction);
      return mark(ids);
    };
    const auto move_at_once = [&] {
      const std::vector<std::uint32_t> ids = moves.movable_at_once(due(), direction);
      moves.move(ids, direction);
      return mark(ids);
    };
    const auto move_walls = [&] {
      std::vector<std::uint32_t> pushed;
      const bool any = moves.move_walls(direction, walls, pushed);
      mark(pushed);
      return any;
    };
    while (move_grains() || move_at_once() || move_walls()) {
    }
  }
}

namespace {

/// Takes from a velocity along a direction what a grain that has free sites in its way was too fast
/// to move. Returns whether it was: slower than a site a step it can move later.
bool slow_down(Velocity<>& velocity, std::int32_t excess, Direction direction) {
  const auto towards = [&](Direction way) {
    return along({velocity.x, velocity.y}, unit_vector(way));
  };
  const std::int32_t speed = towards(direction);
  if (speed <= kSpacing || std::ranges::any_of(lattice::kDirections, [&](Direction other) {
        return towards(other) > speed;
      })) {
    return false;  // or its velocity is that of another direction
  }
  Vector slower = {velocity.x, velocity.y};
  subtract_along(slower, std::min(excess, speed - kSpacing), direction);
  velocity.x = slower.x;
  velocity.y = slower.y;
  return true;
}

/// Cuts the remainder of a grain and calls `visit` with each direction and the excess.
template <class Visit>
void cut(Vector& remainder, Visit visit) {
  // Fitted. With 3/4 of a site, dense flow would lose too much of its distance.
  constexpr std::int32_t kMost = 2 * kSpacing;
  if (squared(remainder) <= product(kMost, kMost)) {
    return;  // so are nearly all
  }
  for (const Direction direction : lattice::kDirections) {
    const std::int32_t excess = along(remainder, unit_vector(direction)) - kMost;
    if (excess > 0) {
      subtract_along(remainder, excess, direction);
      visit(direction, excess);
    }
  }
}

/// The sum of all pushes of a grain.
struct PushSum {
  std::int64_t pushes = 0;  // their number
  std::int64_t x = 0;       // impulse
  std::int64_t y = 0;
};

}  // namespace

void collide_blocked(State& state, const SiteMoves& moves, const BodyVelocities& bodies,
                     std::span<const std::uint32_t> ids, LastStep& step) {
  std::vector<Contact>& pushes = step.blocked_collisions;
  for (const std::uint32_t id : ids) {
    cut(state.remainders[id], [&](Direction direction, std::int32_t excess) {
      const grains::Owner other = moves.blocking_owner(id, direction);
      const UnitVector& unit = unit_vector(direction);
      if (other != grains::kFree) {
        pushes.push_back({.upper = id, .other = other, .normal = {-unit.x, -unit.y}});
      } else if (slow_down(bodies.velocity(grains::as_owner(id)), excess, direction)) {
        step.had_too_fast_grain = true;
      }
    });
  }
  const auto closing = [&](const Contact& push) {
    const Velocity<>& own = bodies.velocity(grains::as_owner(push.upper));
    const Velocity<>& its = bodies.velocity(push.other);
    return along({its.x - own.x, its.y - own.y}, push.normal);
  };
  std::erase_if(pushes, [&](const Contact& push) { return closing(push) <= 0; });
  std::ranges::stable_sort(pushes, {}, &Contact::upper);
  const auto inverse_mass = [&](std::uint32_t id) {
    const std::int32_t with_wall = pair_index(state.grains, id, kFloor);
    return bodies.rule.pair_coefficients[static_cast<std::size_t>(with_wall)].upper_inverse_mass;
  };
  std::map<std::uint32_t, PushSum> sums;  // by id
  for (const Contact& push : pushes) {
    ++sums[push.upper].pushes;
    if (grains::is_particle(push.other)) {
      ++sums[grains::particle_id(push.other)].pushes;
    }
  }
  for (Contact& push : pushes) {
    const std::uint32_t other = grains::particle_id(push.other);
    PushSum& own = sums[push.upper];
    PushSum* its = grains::is_particle(push.other) ? &sums[other] : nullptr;
    const std::int64_t inverse = own.pushes * inverse_mass(push.upper) +
                                 (its != nullptr ? its->pushes * inverse_mass(other) : 0);
    const std::int32_t impulse =
        clamped((std::int64_t{closing(push)} << kInverseMassBits) / inverse, 0, kMaxImpulse);
    push.transient.normal = impulse;
    const std::int32_t x = rounded(product(impulse, -push.normal.x), kUnitBits);
    const std::int32_t y = rounded(product(impulse, -push.normal.y), kUnitBits);
    own.x -= x;
    own.y -= y;
    if (its != nullptr) {
      its->x += x;
      its->y += y;
    }
  }
  for (const auto& [id, total] : sums) {
    Velocity<>& velocity = bodies.velocity(grains::as_owner(id));
    const auto change = [inverse = inverse_mass(id)](std::int32_t& value, std::int64_t impulse) {
      const std::int32_t most = clamped(impulse, -2 * kMaxImpulse, 2 * kMaxImpulse - 1);
      value = clamped(value + limited(product(most, inverse), kInverseMassBits, 2 * kMaxVelocity),
                      -kMaxVelocity, kMaxVelocity);
    };
    change(velocity.x, total.x);
    change(velocity.y, total.y);
  }
}

namespace {

// A wall behind its motion adds 1/16 of the lag per step to its velocity, at most half a spacing
// (units of grains::kMotionUnitsPerSpacing).
// A weaker push is lost in the bed, which two sweeps make elastic: with 1/64 and 1/8 spacing, walls
// took two to four times as long.
constexpr std::int64_t kLagSteps = 16;
constexpr std::int64_t kMaxCatchUp = grains::kMotionUnitsPerSpacing / 2;

/// `speed`: of the motion; if that has ended, the wall still has to arrive.
std::int64_t catch_up_velocity(std::int64_t ahead, std::int32_t speed) {
  const std::int64_t least =
      speed == 0 ? grains::kMotionUnitsPerSpacing / 2 : grains::kMotionUnitsPerSpacing;
  return std::abs(ahead) > least ? std::clamp(ahead / kLagSteps, -kMaxCatchUp, kMaxCatchUp) : 0;
}

}  // namespace

WallVelocities wall_velocities(const State& state) {
  WallVelocities result(state.grains.walls.size());
  for (std::size_t number = 0; number < result.size(); ++number) {
    const grains::Wall& wall = state.grains.walls[number];
    if (!wall.in_motion()) {
      continue;
    }
    const std::int64_t ahead = state.wall_remainders[number];
    constexpr auto kUnit = static_cast<std::int32_t>(kSpacing / grains::kMotionUnitsPerSpacing);
    const std::int32_t own = grains::next_displacement(*wall.motion, wall.travel, ahead);
    const std::int32_t speed =
        kUnit * (own + static_cast<std::int32_t>(catch_up_velocity(ahead, own)));
    const UnitVector& unit = unit_vector(wall.motion->direction);
    result[number].x = rounded(product(speed, unit.x), kUnitBits);
    result[number].y = rounded(product(speed, unit.y), kUnitBits);
  }
  return result;
}

std::vector<WallMove> advance_walls(State& state) {
  std::vector<WallMove> result;
  for (std::size_t number = 0; number < state.grains.walls.size(); ++number) {
    const grains::Wall& wall = state.grains.walls[number];
    if (!wall.in_motion()) {
      continue;
    }
    std::int64_t& ahead = state.wall_remainders[number];
    ahead += grains::next_displacement(*wall.motion, wall.travel, ahead);
    result.push_back({.wall = number,
                      .desired = (ahead > grains::kMotionUnitsPerSpacing / 2 ? 1 : 0) -
                                 (ahead < -grains::kMotionUnitsPerSpacing / 2 ? 1 : 0)});
  }
  return result;
}

bool walls_are_at_rest(const State& state) {
  for (std::size_t number = 0; number < state.grains.walls.size(); ++number) {
    const grains::Wall& wall = state.grains.walls[number];
    if (!wall.in_motion() || is_over(*wall.motion, wall.travel)) {
      continue;
    }
    const std::int64_t ahead = state.wall_remainders[number];
    const std::int32_t own = grains::next_displacement(*wall.motion, wall.travel, ahead);
    const bool pushes_no_harder =
        own == 0 || std::abs(catch_up_velocity(ahead, own)) == kMaxCatchUp;
    // A motion that may turn back is not held up for good.
    const bool held_up =
        pending_step(*wall.motion, wall.travel) != 0 && wall.travel.stalled_since &&
        state.grains.step - *wall.travel.stalled_since >= kSettlingSteps && pushes_no_harder;
    if (!held_up) {
      return false;
    }
  }
  return true;
}

}  // namespace clca::contact
