// The two ways to carry out batches, and what contacts become in them.

#include "contact/engine/batch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "contact/engine/contacts.hpp"
#include "support/states.hpp"
#include "touching_pairs.hpp"

namespace clca::contact::batch_test {
namespace {

constexpr std::size_t kGrains = 40;

struct Workload {
  std::vector<AlignedVelocity> bodies = std::vector<AlignedVelocity>(kGrains + 1);
  std::vector<Batch> batches;
};

std::vector<PairCoefficients> many_pairs() {
  std::vector<PairCoefficients> all;
  for (const int radius : {0, 1, 3, 60}) {
    for (const std::optional<int> other :
         {std::optional<int>(0), std::optional<int>(2), std::optional<int>()}) {
      all.push_back(pair_of(radius, other));
    }
  }
  return all;
}

/// Some lanes are empty; up to `fastest` and `strongest`.
Workload any_workload(std::mt19937_64& random, const std::vector<PairCoefficients>& pairs,
                      Number fastest, Number strongest) {
  Workload load;
  for (std::size_t id = 1; id <= kGrains; ++id) {
    load.bodies[id] = {any_velocity(random, fastest)};
  }
  std::uniform_int_distribution<Number> part(-strongest, strongest);
  std::vector<Number> ids(kGrains);
  std::iota(ids.begin(), ids.end(), 1);
  for (int i = 0; i < 4; ++i) {
    Batch& batch = load.batches.emplace_back();
    std::shuffle(ids.begin(), ids.end(), random);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (random() % 4 == 0) {
        continue;
      }
      const UnitVector normal = any_normal(random);
      const std::size_t pair = random() % pairs.size();
      batch.pair_index[lane] = static_cast<Number>(pair);
      batch.upper[lane] = ids[2 * lane];
      batch.other[lane] = pairs[pair].other_inverse_mass == 0 ? kRestingBody : ids[2 * lane + 1];
      batch.normal_x[lane] = normal.x;
      batch.normal_y[lane] = normal.y;
      batch.impulse.normal[lane] = std::abs(part(random));
      batch.impulse.shear[lane] = part(random);
      batch.impulse.rolling[lane] = part(random);
      batch.bounce_velocity[lane] = std::abs(part(random)) / 4;
      batch.friction[lane] = ratio(random() % 5 == 0 ? 1e9 : 0.5);
    }
  }
  return load;
}

void expect_same(const Workload& one, const Workload& other) {
  for (std::size_t id = 0; id < one.bodies.size(); ++id) {
    ASSERT_EQ(one.bodies[id].velocity, other.bodies[id].velocity) << id;
  }
  for (std::size_t i = 0; i < one.batches.size(); ++i) {
    ASSERT_EQ(one.batches[i].impulse, other.batches[i].impulse) << i;
  }
}

TEST(PassFunction, GivesTheSameBitsInAnyWay) {
  std::mt19937_64 random(1);
  const PassFunction plain = plain_pass_function();
  const PassFunction fastest = fastest_pass_function();
  const std::vector<PairCoefficients> pairs = many_pairs();
  for (int trial = 0; trial < 3000; ++trial) {
    const bool extreme = trial % 3 == 0;
    Workload one = any_workload(random, pairs, extreme ? kMaxVelocity : kSpacing,
                                extreme ? kMaxImpulse : kSpacing);
    Workload other = one;
    const bool turns = random() % 2 == 0;
    const LawConstants law = {.rotates = turns,
                              .resists_rolling = turns && random() % 2 == 0,
                              .rolling_friction = ratio(0.5)};
    for (const auto& [carry_out_pass, load] :
         {std::pair<PassFunction, Workload&>(plain, one), {fastest, other}}) {
      for (const Pass pass : {Pass::warm_start, Pass::forwards, Pass::backwards}) {
        carry_out_pass(pass, load.batches, load.bodies.data(), pairs.data(), law);
      }
    }
    expect_same(one, other);
    EXPECT_EQ(one.bodies[kRestingBody].velocity, Velocity<Number>()) << "a wall is at rest";
  }
}

grains::State like_grains(std::size_t count) {
  grains::State grains = testing::empty_state(30, 40);
  grains.kinds = {{lattice::Shape::hexagon(1), 0}};
  grains.particles.resize(count);
  return grains;
}

struct Bed {
  explicit Bed(std::size_t count) : grains(like_grains(count)) {}

  grains::State grains;
  Rule rule = make_rule(grains, {}, 0.01);
  ContactSlots slots = ContactSlots(grains, rule);
};

TEST(ContactSlots, HoldContactsThatShareNoGrainAndKeepTheOrderOfThoseThatDo) {
  std::mt19937_64 random(2);
  Bed bed(kGrains);
  ContactSlots& slots = bed.slots;
  slots.clear(kGrains);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts;
  for (int i = 0; i < 300; ++i) {
    const auto upper = static_cast<std::uint32_t>(random() % kGrains);
    const auto other = static_cast<std::uint32_t>((upper + 1 + random() % (kGrains - 1)) % kGrains);
    const bool on_wall = random() % 4 == 0;
    contacts.emplace_back(upper, on_wall ? upper : other);
    slots.add_contact({.upper = upper, .other = on_wall ? kFloor : grains::as_owner(other)}, {});
  }
  const auto batch_of = [&](std::size_t i) {
    return slots.slots()[i].lane / static_cast<int>(kLanes);
  };
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool share =
          contacts[i].first == contacts[j].first || contacts[i].first == contacts[j].second ||
          contacts[i].second == contacts[j].first || contacts[i].second == contacts[j].second;
      EXPECT_TRUE(!share || batch_of(j) < batch_of(i));
      EXPECT_NE(slots.slots()[i].lane, slots.slots()[j].lane);
    }
  }
}

TEST(ContactSlots, HaveNothingInALaneThatIsEmptied) {
  Bed bed(3);
  ContactSlots& slots = bed.slots;
  slots.clear(3);
  const Contact contact = {
      .upper = 0, .other = 1, .normal = {0, 1 << kUnitBits}, .impulse = {100, 20, 3}};
  slots.add_contact(contact, {});
  EXPECT_EQ(slots.contact(0), contact);
  slots.remove_contact(0);
  std::vector<AlignedVelocity> bodies(4, {{7, 8, 9}});
  bodies[kRestingBody] = {};
  const PairCoefficients* pairs = bed.rule.pair_coefficients.data();
  for (const PassFunction carry_out_pass : {plain_pass_function(), fastest_pass_function()}) {
    for (const Pass pass : {Pass::warm_start, Pass::forwards}) {
      carry_out_pass(pass, slots.batches(), bodies.data(), pairs, {.rotates = true});
    }
    EXPECT_EQ(bodies[1].velocity, (Velocity<Number>{7, 8, 9}));
    EXPECT_EQ(bodies[kRestingBody].velocity, Velocity<Number>());
  }
}

}  // namespace
}  // namespace clca::contact::batch_test
