#include "contact/rule/impacts.hpp"

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
  explicit Groups(std::size_t grains) : next_(grains), size_(grains, 1), hit_(grains, false) {
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
  void hit(std::size_t grain) { hit_[of(grain)] = true; }
  /// `group`: see of().
  bool is_isolated_impact(std::size_t group) const {
    return hit_[group] && size_[group] <= kMostGrains;
  }

 private:
  std::vector<std::size_t> next_;
  std::vector<std::size_t> size_;
  std::vector<bool> hit_;
};

}  // namespace

std::vector<std::vector<Touch*>> isolated_impacts(std::span<Touch> contacts, std::size_t grains) {
  Groups groups(grains);
  for (const Touch& touch : contacts) {
    if (grains::is_particle(touch.contact.other)) {
      groups.connect(touch.contact.upper, grains::particle_id(touch.contact.other));
    }
  }
  for (const Touch& touch : contacts) {
    if (touch.bounce > 0) {
      groups.hit(touch.contact.upper);
    }
  }
  std::map<std::size_t, std::vector<Touch*>> by_group;
  for (Touch& touch : contacts) {
    const std::size_t group = groups.of(touch.contact.upper);
    if (groups.is_isolated_impact(group)) {
      by_group[group].push_back(&touch);
    }
  }
  std::vector<std::vector<Touch*>> result;
  for (auto& [group, impact] : by_group) {
    result.push_back(std::move(impact));
  }
  return result;
}

void solve_impact(std::span<Touch* const> contacts, const grains::State& grains, const Rule& rule,
                  const VelocityOf& velocity_of) {
  // A column of eight grains needs some 200. Rounding keeps some from an exact end.
  constexpr int kMostSweeps = 256;
  constexpr std::int32_t kSmallChange = kSpacing >> 15;
  std::int32_t change = kMaxImpulse;
  for (int i = 0; i < kMostSweeps && change > kSmallChange; ++i) {
    change = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      Touch& touch = *contacts[i % 2 == 0 ? k : contacts.size() - 1 - k];
      Contact& contact = touch.contact;
      const Impulse<std::int32_t> before = contact.impact;
      at_contact(contact, grains, rule, velocity_of, [&](ContactState<std::int32_t>& touching) {
        solve(contact.impact, touching, touch.bounce, rule.friction_with(contact.other), rule.law);
      });
      change = std::max({change, std::abs(contact.impact.normal - before.normal),
                         std::abs(contact.impact.shear - before.shear),
                         std::abs(contact.impact.rolling - before.rolling)});
    }
  }
  for (Touch* touch : contacts) {
    touch->bounce = 0;
  }
}

}  // namespace clca::contact
