#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "clca/measure/force.hpp"
#include "pushed_states.hpp"
#include "support/overlaps.hpp"

namespace clca::measure::contacts_test {
namespace {

using grains::kFirstWall;
using grains::Occupancy;
using grains::Owner;
using grains::State;
using lattice::kColumnPitch;
using lattice::Shape;
using ::testing::ElementsAre;

std::vector<OverlapContact> contacts_of(const State& state) {
  return overlap_contacts(state, Occupancy(state));
}

TEST(Contacts, AreAllPairsThatShareSitesWallsFirst) {
  const auto found = contacts_of(testing::pushed_state());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].first, 0U);
  EXPECT_EQ(found[0].second, kFirstWall);
  EXPECT_EQ(found[0].shared_sites, 1);
  EXPECT_EQ(found[0].depth, 1);
  EXPECT_EQ(found[0].source_wall, 0U);
  EXPECT_TRUE(found[0].point.isApprox(Eigen::Vector2d(10 * kColumnPitch, 12)));
  EXPECT_EQ(found[1].first, 0U);
  EXPECT_EQ(found[1].second, 1);
  EXPECT_EQ(found[1].shared_sites, 1);
  EXPECT_EQ(found[1].depth, 1);
  EXPECT_EQ(found[1].source_wall, 0U);
  EXPECT_TRUE(found[1].point.isApprox(Eigen::Vector2d(10 * kColumnPitch, 10)));
  EXPECT_THAT(force_indices(3, found), ElementsAre(2, 1, 0));
}

TEST(Contacts, AreNoneWhereNothingMayOverlap) {
  State state = testing::empty_state(20, 20);
  state.kinds = {{Shape::hexagon(1), 0}};
  state.particles = {testing::particle_at(5, 5), testing::particle_at(5, 8)};
  EXPECT_TRUE(contacts_of(state).empty());
}

TEST(Contacts, KnowTheirSourceWhicheverOfThePairWasPushed) {
  State state = testing::pushed_state();
  state.walls.push_back(testing::plate({{30, 30}}));
  state.pushes = {{.pushed = 0, .pusher = kFirstWall, .source = 0},
                  {.pushed = 0, .pusher = 1, .source = 1}};
  const auto found = contacts_of(state);
  EXPECT_EQ(found.at(0).source_wall, 0U);
  EXPECT_EQ(found.at(1).source_wall, 1U);
}

TEST(Contacts, OfAWallThatNoSingleMoveLeavesAreOfDepthTwo) {
  State state = testing::pushed_state();
  state.walls[0].sites = {{10, 11}, {10, 12}};
  const OverlapContact contact = contacts_of(state).at(0);
  EXPECT_EQ(contact.shared_sites, 2);
  EXPECT_EQ(contact.depth, 2);
  EXPECT_TRUE(contact.point.isApprox(Eigen::Vector2d(10 * kColumnPitch, 11.5)));
}

TEST(Contacts, AcrossASeamLieInTheBox) {
  State state = testing::pushed_state();
  state.lattice = lattice::Lattice(12, 40, true);
  state.particles = {testing::particle_at(24, 25), testing::particle_at(-12, 23)};
  state.pushes = {{.pushed = 1, .pusher = 0}};
  const auto found = contacts_of(state);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].depth, 1);
  EXPECT_NEAR(found[0].point.x(), 0, 1e-12);
  EXPECT_DOUBLE_EQ(found[0].point.y(), 24);
}

/// Hexagons thrown onto each other, no more than two on a site.
State crowd(unsigned seed) {
  State state = testing::empty_state(24, 24);
  state.kinds = {{Shape::hexagon(1), 0}, {Shape::hexagon(2), 1}};
  state.walls = {testing::plate({{0, 23}})};
  std::mt19937 random(seed);
  std::map<lattice::Site, std::vector<std::uint32_t>> owners;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const auto particle = testing::particle_at(2 + static_cast<int>(random() % 20U),
                                               2 + static_cast<int>(random() % 19U),
                                               static_cast<std::uint16_t>(random() % 2U));
    const auto& parts = state.shape(particle).sites();
    if (std::all_of(parts.begin(), parts.end(), [&](lattice::Axial part) {
          return owners[particle.site() + part].size() < 2;
        })) {
      for (const lattice::Axial part : parts) {
        owners[particle.site() + part].push_back(
            static_cast<std::uint32_t>(state.particles.size()));
      }
      state.particles.push_back(particle);
    }
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& [site, ids] : owners) {
    if (ids.size() == 2) {
      pairs.emplace(ids[1], ids[0]);
    }
  }
  for (const auto& [pushed, pusher] : pairs) {
    state.pushes.push_back({.pushed = pushed, .pusher = grains::as_owner(pusher)});
  }
  return state;
}

TEST(Contacts, CountTheSitesCommonToBothParticles) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const State state = crowd(seed);
    const auto found = contacts_of(state);
    EXPECT_EQ(found.size(), state.pushes.size());
    for (const OverlapContact& contact : found) {
      const auto& first = state.particles[contact.first];
      const auto& second = state.particles[static_cast<std::size_t>(contact.second)];
      const auto& parts = state.shape(first).sites();
      const auto common = std::count_if(parts.begin(), parts.end(), [&](lattice::Axial part) {
        return state.shape(second).contains(first.site() + part - second.site());
      });
      EXPECT_EQ(contact.shared_sites, common);
      constexpr int kMost = 2;
      EXPECT_EQ(contact.depth,
                testing::depth(state, testing::body_of(state, grains::as_owner(contact.first)),
                               testing::body_of(state, contact.second), kMost));
      EXPECT_EQ(contact.source_wall, 0U);
    }
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return std::pair(a.first, a.second) < std::pair(b.first, b.second);
    }));
  }
}

TEST(Contacts, DoNotDependOnTheOrderOfTheParticles) {
  const State state = crowd(7);
  State mirrored = state;
  std::reverse(mirrored.particles.begin(), mirrored.particles.end());
  const auto last = static_cast<std::uint32_t>(state.particles.size() - 1);
  for (grains::Push& push : mirrored.pushes) {
    push.pushed = last - push.pushed;
    push.pusher = grains::as_owner(last) - push.pusher;
  }
  std::sort(mirrored.pushes.begin(), mirrored.pushes.end(), [](const auto& a, const auto& b) {
    return std::pair(a.pushed, a.pusher) < std::pair(b.pushed, b.pusher);
  });
  const auto indices = force_indices(state.particles.size(), contacts_of(state));
  auto other = force_indices(state.particles.size(), contacts_of(mirrored));
  std::reverse(other.begin(), other.end());
  EXPECT_EQ(indices, other);
}

}  // namespace
}  // namespace clca::measure::contacts_test
