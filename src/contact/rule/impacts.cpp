#include "contact/rule/impacts.hpp"

#include <algorithm>
#include <map>

#include "contact/rule/groups.hpp"

namespace clca::contact {

namespace {

/// Relative velocities of the bodies of each contact, as Impulse has the impulses.
using Motions = std::vector<Impulse<std::int32_t>>;

Motions motions(std::span<Touch* const> contacts, const grains::State& grains, const Rule& rule,
                const VelocityOf& velocity_of) {
  Motions result;
  for (const Touch* touch : contacts) {
    at_contact(touch->contact, grains, rule, velocity_of, [&](const auto& touching) {
      result.push_back({.normal = separation_velocity(touching),
                        .shear = slip_velocity(touching),
                        .rolling = rolling_velocity(touching)});
    });
  }
  return result;
}

/// The sum over all contacts of impulse times velocity.
std::int64_t power(std::span<Touch* const> contacts, const Motions& motions) {
  constexpr int kBits = 20;  // so that the share below fits
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Impulse<std::int32_t>& impulse = contacts[i]->contact.impact;
    sum += scaled(product(impulse.normal, motions[i].normal), kBits) +
           scaled(product(impulse.shear, motions[i].shear), kBits) +
           scaled(product(impulse.rolling, motions[i].rolling), kBits);
  }
  return sum;
}

/// The share of the impulses that may act once more without a gain of energy. With impulses P,
/// velocities v before and c after them, and s times P once more, the kinetic energy changes by
/// (1+s)/2 ((1-s) v.P + (1+s) c.P). If nothing closes or slides any more, c.P <= 0, and any s up to
/// 1 will do; after a limited number of sweeps less may do.
std::int32_t most_again(std::int64_t before, std::int64_t after) {
  constexpr std::int32_t kOne = 1 << kRatioBits;
  const std::int64_t gain = after - before;  // P.P over the masses
  return gain <= 0 ? -kOne : clamped(kOne - 2 * after * kOne / gain, -kOne, kOne);
}

}  // namespace

void solve_impact(std::span<Touch* const> contacts, const grains::State& grains, const Rule& rule,
                  const VelocityOf& velocity_of) {
  std::map<grains::Owner, Velocity<std::int32_t>> velocities;  // of the grains, before
  for (const Touch* touch : contacts) {
    for (const grains::Owner body :
         {grains::as_owner(touch->contact.upper), touch->contact.other}) {
      if (grains::is_particle(body)) {
        velocities.emplace(body, velocity_of(body));
      }
    }
  }
  const Motions before = motions(contacts, grains, rule, velocity_of);
  converge(contacts, &Contact::impact, grains, rule, velocity_of);
  const Motions after = motions(contacts, grains, rule, velocity_of);
  const std::int32_t again =
      std::min(rule.restitution, most_again(power(contacts, before), power(contacts, after)));
  const auto more = [&](std::int32_t value, std::int32_t by, std::int32_t most) {
    return clamped(value + rounded(product(by, again), kRatioBits), -most, most);
  };
  // What the impulses have changed they change again. (One by one, those on a light grain between
  // heavy ones would exceed the bound of velocities.)
  for (const auto& [body, was] : velocities) {
    Velocity<std::int32_t>& now = velocity_of(body);
    now = {.x = more(now.x, now.x - was.x, kMaxVelocity),
           .y = more(now.y, now.y - was.y, kMaxVelocity),
           .spin = more(now.spin, now.spin - was.spin, kMaxVelocity)};
  }
  for (Touch* touch : contacts) {
    const Impulse<std::int32_t> impulse = touch->contact.impact;
    touch->contact.impact = {.normal = more(impulse.normal, impulse.normal, kMaxImpulse),
                             .shear = more(impulse.shear, impulse.shear, kMaxImpulse),
                             .rolling = more(impulse.rolling, impulse.rolling, kMaxImpulse)};
    touch->bounce = 0;
  }
}

}  // namespace clca::contact
