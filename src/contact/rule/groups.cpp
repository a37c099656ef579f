#include "contact/rule/groups.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>

namespace clca::contact {

namespace {

/// Grains that contacts connect.
class Groups {
 public:
  explicit Groups(std::size_t grains) : next_(grains), size_(grains, 1) {
    std::iota(next_.begin(), next_.end(), std::size_t{0});
  }

  /// The grain that stands for the group of `grain`.
  std::size_t of(std::size_t grain) {
    while (next_[grain] != grain) {
      grain = next_[grain] = next_[next_[grain]];
    }
    return grain;
  }
  void connect(std::size_t first, std::size_t second) {
    first = of(first);
    second = of(second);
    if (first != second) {
      next_[second] = first;
      size_[first] += size_[second];
    }
  }
  /// `group`: see of().
  bool is_small(std::size_t group) const { return size_[group] <= kMostGrains; }

 private:
  std::vector<std::size_t> next_;
  std::vector<std::size_t> size_;
};

}  // namespace

std::vector<std::vector<Touch*>> active_groups(std::span<Touch> contacts, std::size_t grains) {
  Groups groups(grains);
  for (const Touch& touch : contacts) {
    if (grains::is_particle(touch.contact.other)) {
      groups.connect(touch.contact.upper, grains::particle_id(touch.contact.other));
    }
  }
  std::map<std::size_t, std::vector<Touch*>> by_group;
  for (Touch& touch : contacts) {
    if (const std::size_t group = groups.of(touch.contact.upper); groups.is_small(group)) {
      by_group[group].push_back(&touch);
    }
  }
  std::vector<std::vector<Touch*>> result;
  for (auto& [group, of_group] : by_group) {
    if (std::any_of(of_group.begin(), of_group.end(), [](const Touch* touch) {
          return touch->contact.impulse.normal > 0 || touch->bounce > 0;
        })) {
      result.push_back(std::move(of_group));
    }
  }
  return result;
}

void converge(std::span<Touch* const> contacts, Impulse<std::int32_t> Contact::*impulse,
              const grains::State& grains, const Rule& rule, const VelocityOf& velocity_of) {
  // A column of eight grains needs some 200. Rounding keeps some from an exact end.
  constexpr int kMostSweeps = 256;
  constexpr std::int32_t kSmallChange = kSpacing >> 15;
  std::int32_t change = kMaxImpulse;
  for (int i = 0; i < kMostSweeps && change > kSmallChange; ++i) {
    change = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      Contact& contact = contacts[i % 2 == 0 ? k : contacts.size() - 1 - k]->contact;
      Impulse<std::int32_t>& now = contact.*impulse;
      const Impulse<std::int32_t> before = now;
      at_contact(contact, grains, rule, velocity_of, [&](ContactState<std::int32_t>& touching) {
        solve(now, touching, 0, rule.friction_with(contact.other), rule.law);
      });
      change =
          std::max({change, std::abs(now.normal - before.normal),
                    std::abs(now.shear - before.shear), std::abs(now.rolling - before.rolling)});
    }
  }
}

void finish(std::span<Touch* const> contacts, const grains::State& grains, const Rule& rule,
            const VelocityOf& velocity_of) {
  std::vector<Impulse<std::int32_t>> remembered;
  for (const Touch* touch : contacts) {
    remembered.push_back(touch->contact.impulse);
  }
  converge(contacts, &Contact::impulse, grains, rule, velocity_of);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Impulse<std::int32_t> sum = std::exchange(contacts[i]->contact.impulse, remembered[i]);
    const auto added = [](std::int32_t value, std::int32_t now, std::int32_t before) {
      return clamped(std::int64_t{value} + now - before, -kMaxImpulse, kMaxImpulse);
    };
    Impulse<std::int32_t>& impact = contacts[i]->contact.impact;
    impact = {.normal = added(impact.normal, sum.normal, remembered[i].normal),
              .shear = added(impact.shear, sum.shear, remembered[i].shear),
              .rolling = added(impact.rolling, sum.rolling, remembered[i].rolling)};
  }
}

}  // namespace clca::contact
