// Impacts among few grains, and groups of few grains, whose contacts are solved to the end.

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>

#include "contact/rule/step.hpp"

namespace clca::contact {

namespace {

/// Impulses by contact.
using Impulses = std::vector<Impulse<>>;

/// The sum over all contacts of impulse times relative velocity of the bodies.
std::int64_t power(std::span<StepContact* const> contacts, const Impulses& impulses,
                   const BodyVelocities& bodies) {
  constexpr int kBits = 20;  // so that the share below fits
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    bodies.visit_contact(contacts[i]->contact, [&](const auto& both) {
      sum += rounded64(product(impulses[i].normal, separation_velocity(both)), kBits) +
             rounded64(product(impulses[i].shear, slip_velocity(both)), kBits) +
             rounded64(product(impulses[i].rolling, rolling_velocity(both)), kBits);
    });
  }
  return sum;
}

/// The share of the impulses that may act once more without a gain of energy. With impulses P,
/// velocities v before and c after them, and s times P once more, the kinetic energy changes by
/// (1+s)/2 ((1-s) v.P + (1+s) c.P). If nothing closes or slides any more, c.P <= 0, and any s up to
/// 1 will do; after a limited number of sweeps less may do.
std::int32_t repeatable_share(std::int64_t before, std::int64_t after) {
  constexpr std::int32_t kOne = 1 << kRatioBits;
  const std::int64_t gain = after - before;  // P.P over the masses
  return gain <= 0 ? -kOne : clamped(kOne - 2 * after * kOne / gain, -kOne, kOne);
}

/// Sweeps over contacts, forwards and backwards in turn, until their impulses hardly change any
/// more; the velocities are as these have made them.
void converge(std::span<StepContact* const> contacts, Impulses& impulses,
              const BodyVelocities& bodies) {
  // A column of eight grains needs some 200. Rounding keeps some from an exact end.
  constexpr int kMostSweeps = 256;
  constexpr std::int32_t kSmallChange = kSpacing >> 15;
  std::int32_t change = kMaxImpulse;
  for (int sweep = 0; sweep < kMostSweeps && change > kSmallChange; ++sweep) {
    change = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const std::size_t i = sweep % 2 == 0 ? k : contacts.size() - 1 - k;
      const Contact& contact = contacts[i]->contact;
      Impulse<>& now = impulses[i];
      const Impulse<> before = now;
      bodies.visit_contact(contact, [&](ContactBodies<>& both) {
        solve_contact(now, both, 0, bodies.rule.friction_with(contact.other), bodies.rule.law);
      });
      change =
          std::max({change, std::abs(now.normal - before.normal),
                    std::abs(now.shear - before.shear), std::abs(now.rolling - before.rolling)});
    }
  }
}

}  // namespace

std::vector<std::vector<StepContact*>> active_small_groups(std::span<StepContact> contacts,
                                                           std::size_t grains) {
  std::vector<std::size_t> group(grains);  // by grain: the lowest id of those it is connected with
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (bool changes = true; changes;) {
    changes = false;
    for (const StepContact& touch : contacts) {
      if (grains::is_particle(touch.contact.other)) {
        std::size_t& upper = group[touch.contact.upper];
        std::size_t& other = group[grains::particle_id(touch.contact.other)];
        changes = changes || upper != other;
        upper = other = std::min(upper, other);
      }
    }
  }
  std::vector<std::size_t> size(grains, 0);
  for (const std::size_t lowest : group) {
    ++size[lowest];
  }
  std::map<std::size_t, std::vector<StepContact*>> by_group;
  for (StepContact& touch : contacts) {
    by_group[group[touch.contact.upper]].push_back(&touch);
  }
  std::vector<std::vector<StepContact*>> result;
  for (auto& [lowest, of_group] : by_group) {
    if (size[lowest] <= kMaxSmallGroup &&
        std::ranges::any_of(of_group, [](const StepContact* touch) {
          return touch->contact.impulse.normal > 0 || touch->bounce_velocity > 0;
        })) {
      result.push_back(std::move(of_group));
    }
  }
  return result;
}

void solve_impact(std::span<StepContact* const> contacts, const BodyVelocities& bodies) {
  if (std::ranges::none_of(contacts,
                           [](const StepContact* touch) { return touch->bounce_velocity > 0; })) {
    return;
  }
  std::map<grains::Owner, Velocity<>> velocities;  // of the grains, before
  for (const StepContact* touch : contacts) {
    for (const grains::Owner body :
         {grains::as_owner(touch->contact.upper), touch->contact.other}) {
      if (grains::is_particle(body)) {
        velocities.emplace(body, bodies.velocity(body));
      }
    }
  }
  const BodyVelocities before = {
      bodies.grains, bodies.rule, [&](grains::Owner body) -> Velocity<>& {
        return grains::is_particle(body) ? velocities.at(body) : bodies.velocity(body);
      }};
  Impulses impulses(contacts.size());
  converge(contacts, impulses, bodies);
  const std::int32_t again = std::min(
      bodies.rule.restitution,
      repeatable_share(power(contacts, impulses, before), power(contacts, impulses, bodies)));
  const auto more = [&](std::int32_t value, std::int32_t by, std::int32_t most) {
    return clamped(value + rounded(product(by, again), kRatioBits), -most, most);
  };
  // What the impulses have changed they change again. (One by one, those on a light grain between
  // heavy ones would exceed the bound of velocities.)
  for (const auto& [body, was] : velocities) {
    Velocity<>& now = bodies.velocity(body);
    now = {.x = more(now.x, now.x - was.x, kMaxVelocity),
           .y = more(now.y, now.y - was.y, kMaxVelocity),
           .spin = more(now.spin, now.spin - was.spin, kMaxVelocity)};
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Impulse<>& impulse = impulses[i];
    contacts[i]->contact.transient = {
        .normal = more(impulse.normal, impulse.normal, kMaxImpulse),
        .shear = more(impulse.shear, impulse.shear, kMaxImpulse),
        .rolling = more(impulse.rolling, impulse.rolling, kMaxImpulse)};
    contacts[i]->bounce_velocity = 0;
  }
}

void converge_group(std::span<StepContact* const> contacts, const BodyVelocities& bodies) {
  Impulses impulses;
  for (const StepContact* touch : contacts) {
    impulses.push_back(touch->contact.impulse);
  }
  converge(contacts, impulses, bodies);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Contact& contact = contacts[i]->contact;
    const auto add = [&](std::int32_t Impulse<>::*part) {
      contact.transient.*part =
          clamped(std::int64_t{contact.transient.*part} + impulses[i].*part - contact.impulse.*part,
                  -kMaxImpulse, kMaxImpulse);
    };
    add(&Impulse<>::normal);
    add(&Impulse<>::shear);
    add(&Impulse<>::rolling);
  }
}

}  // namespace clca::contact
