// Who touches whom, from step to step and in which order.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "contact/rule/touching.hpp"
#include "support/states.hpp"

namespace clca::contact::contact_list_test {
namespace {

using testing::empty_state;
using testing::particle_at;

/// Hexagons of radius 1 with their reference sites there.
grains::State hexagons(const std::vector<lattice::Site>& sites, int columns = 30) {
  grains::State state = empty_state(columns, 40);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  for (const lattice::Site site : sites) {
    state.particles.push_back(particle_at(site.column, site.row));
    state.origins.push_back(site);
  }
  return state;
}

constexpr lattice::Direction kDown = lattice::Direction::down;

std::vector<StepContact> touches_of(grains::State state) {
  NormalTable normals(state.kinds);
  return all_contacts(grains::Box(state), kDown, normals, WallVelocities(state.walls.size()));
}

using BodyPair = std::pair<std::uint32_t, grains::Owner>;

std::vector<BodyPair> pairs(const std::vector<StepContact>& contacts) {
  std::vector<BodyPair> result;
  for (const StepContact& one : contacts) {
    result.emplace_back(one.contact.upper, one.contact.other);
  }
  return result;
}

TEST(Touches, NameTheUpperGrainTheFloorAndTheSides) {
  // One in the corner, one upon it, one alone.
  const grains::State state = hexagons({{1, 1}, {1, 4}, {20, 20}});
  const std::vector<StepContact> found = touches_of(state);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ((BodyPair{found[0].contact.upper, found[0].contact.other}), (BodyPair{0, kFloor}));
  EXPECT_EQ(found[0].contact.normal, (UnitVector{0, 1 << kUnitBits}));
  EXPECT_EQ((BodyPair{found[1].contact.upper, found[1].contact.other}), (BodyPair{0, kLeftSide}));
  EXPECT_EQ(found[1].contact.normal, (UnitVector{1 << kUnitBits, 0}));
  EXPECT_EQ((BodyPair{found[2].contact.upper, found[2].contact.other}), (BodyPair{1, kLeftSide}));
  EXPECT_EQ((BodyPair{found[3].contact.upper, found[3].contact.other}), (BodyPair{1, 0}));
  EXPECT_EQ(found[3].to_other, (lattice::Axial{0, -3}));
}

TEST(Touches, NameWallsAndReachAcrossThePeriodicSeam) {
  grains::State state = hexagons({{0, 20}, {17, 20}}, 20);
  state.lattice = lattice::Lattice(20, 40, true);
  state.walls = {{.sites = {{10, 10}}}, {.sites = {{17, 18}}}};
  const std::vector<StepContact> found = touches_of(state);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ((BodyPair{found[0].contact.upper, found[0].contact.other}),
            (BodyPair{1, grains::wall_code(1)}));
  EXPECT_EQ(found[0].contact.normal, (UnitVector{0, 1 << kUnitBits}));
  // The grain in column 17 is half a site higher.
  EXPECT_EQ((BodyPair{found[1].contact.upper, found[1].contact.other}), (BodyPair{1, 0}));
  EXPECT_EQ(found[1].to_other.x, 3);
}

TEST(TheUpperOfTwo, IsTheHigherOrTheLeftOne) {
  const grains::State state = hexagons({{4, 10}, {4, 14}, {8, 10}, {7, 10}});
  EXPECT_TRUE(is_above(state, kDown, 1, 0));
  EXPECT_TRUE(is_above(state, kDown, 0, 2));
  EXPECT_FALSE(is_above(state, kDown, 2, 0));
  EXPECT_TRUE(is_above(state, kDown, 3, 0)) << "odd columns stand half a site higher";
}

TEST(TheOrder, GoesDownAndFromTheLeft) {
  const grains::State state = hexagons({{10, 5}, {10, 30}, {40, 30}, {131, 30}, {300, 5}}, 500);
  const std::vector<std::uint32_t> expected = {3, 1, 2, 0, 4};
  std::vector<std::uint32_t> order = {0, 1, 2, 3, 4};
  std::sort(order.begin(), order.end(), [&](std::uint32_t one, std::uint32_t other) {
    return order_key(state, kDown, one) < order_key(state, kDown, other);
  });
  EXPECT_EQ(order, expected);
}

TEST(NextContacts, KeepTheirPlaceAndTheirImpulsesAndNewOnesAreBehind) {
  // A pile of three on the floor; the one on top is listed first when all is sorted.
  const grains::State state = hexagons({{10, 1}, {10, 4}, {10, 7}});
  const std::vector<StepContact> now = touches_of(state);
  const std::vector<Contact> before = {
      {.upper = 0, .other = kFloor, .normal = {0, 1 << kUnitBits}, .impulse = {5, 4, 3}}};
  const auto kept = next_contacts(state, before, now, kDown, false);
  EXPECT_EQ(pairs(kept), (std::vector<BodyPair>{{0, kFloor}, {2, 1}, {1, 0}}));
  EXPECT_EQ(kept[0].contact.impulse, (Impulse<std::int32_t>{5, 4, 3}));
  EXPECT_EQ(kept[1].contact.impulse, Impulse<std::int32_t>());

  const auto sorted = next_contacts(state, before, now, kDown, true);
  EXPECT_EQ(pairs(sorted), (std::vector<BodyPair>{{2, 1}, {1, 0}, {0, kFloor}}));
  EXPECT_EQ(sorted[2].contact.impulse, (Impulse<std::int32_t>{5, 4, 3}));
}

TEST(NextContacts, LeaveOutWhatNoLongerTouches) {
  const grains::State state = hexagons({{10, 1}, {20, 20}});
  const std::vector<Contact> before = {{.upper = 1, .other = 0, .impulse = {9, 0, 0}},
                                       {.upper = 0, .other = kFloor, .normal = {0, 1 << kUnitBits}},
                                       {.upper = 1, .other = kLeftSide}};
  EXPECT_EQ(pairs(next_contacts(state, before, touches_of(state), kDown, false)),
            (std::vector<BodyPair>{{0, kFloor}}));
}

TEST(NextContacts, OfAPairThatHasTurnedOverKeepTheImpulseWithTheMomentReversed) {
  const grains::State state = hexagons({{10, 20}, {10, 23}});
  const std::vector<Contact> before = {{.upper = 0, .other = 1, .impulse = {50, -20, 7}}};
  const auto next = next_contacts(state, before, touches_of(state), kDown, false);
  ASSERT_EQ(pairs(next), (std::vector<BodyPair>{{1, 0}}));
  EXPECT_EQ(next[0].contact.impulse, (Impulse<std::int32_t>{50, -20, -7}));
}

}  // namespace
}  // namespace clca::contact::contact_list_test
