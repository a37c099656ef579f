// Remainders that are cut, and the momentum that is passed on.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "contact/rule/moves.hpp"
#include "support/states.hpp"

namespace clca::contact::cuts_test {
namespace {

using lattice::Direction;

/// Hexagons of radius 1 and 2, and upright rods.
struct Bench {
  State state = {.grains = testing::empty_state(30, 60)};

  Bench() {
    std::vector<lattice::Axial> rod;
    for (int q = 0; q < 20; ++q) {
      rod.push_back({0, q});
    }
    state.grains.kinds = {
        {lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 0}, {lattice::Shape(rod), 0}};
  }
  void add(lattice::Site site, Vector remainder, Velocity<std::int32_t> velocity,
           std::uint16_t kind = 0) {
    state.grains.particles.push_back(testing::particle_at(site.column, site.row, kind));
    state.remainders.push_back(remainder);
    state.velocities.push_back(velocity);
  }
  void cut(std::vector<std::uint32_t> ids = {}) {
    if (ids.empty()) {
      ids.resize(state.grains.particles.size());
      std::iota(ids.begin(), ids.end(), 0U);
    }
    const Rule rule = make_rule(state.grains, {.rolling = Rolling::none}, 1.0 / 64);
    grains::Box box(state.grains);
    const SiteMoves moves(state, box);
    Velocity<std::int32_t> fixed;
    const BodyVelocities bodies = {
        state.grains, rule, [&](grains::Owner body) -> Velocity<>& {
          return grains::is_particle(body) ? state.velocities[grains::particle_id(body)] : fixed;
        }};
    LastStep step;
    collide_blocked(state, moves, bodies, ids, step);
    EXPECT_EQ(fixed, Velocity<std::int32_t>());
  }
  double mass(std::size_t id) const {
    return static_cast<double>(state.grains.shape(state.grains.particles[id]).size());
  }
  Eigen::Vector2d momentum() const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t id = 0; id < state.velocities.size(); ++id) {
      sum += mass(id) * Eigen::Vector2d(state.velocities[id].x, state.velocities[id].y);
    }
    return sum;
  }
  double energy() const {
    double sum = 0;
    for (std::size_t id = 0; id < state.velocities.size(); ++id) {
      sum += mass(id) *
             Eigen::Vector2d(state.velocities[id].x, state.velocities[id].y).squaredNorm() / 2;
    }
    return sum;
  }
};

constexpr Vector kFarBelow = {0, -3 * kSpacing};

// Beyond eight sites, which no velocity of any use leaves, some would be left.
TEST(ARemainder, IsCutToTwoSitesInEveryDirection) {
  for (const double angle : {0.0, 0.3, 1.0, 2.5, 4.0}) {
    for (const double distance : {0.5, 1.9, 2.2, 5.0, 8.0}) {
      const Vector before = {static_cast<std::int32_t>(distance * kSpacing * std::cos(angle)),
                             static_cast<std::int32_t>(distance * kSpacing * std::sin(angle))};
      Bench bench;
      bench.add({10, 20}, before, {kSpacing / 2, kSpacing / 2, 0});
      bench.cut();
      const Vector& after = bench.state.remainders[0];
      for (const Direction direction : lattice::kDirections) {
        EXPECT_LE(along(after, unit_vector(direction)), 2 * kSpacing + 4);
      }
      if (distance < 2) {
        EXPECT_EQ(after, before);
      }
      EXPECT_EQ(bench.state.velocities[0], (Velocity<std::int32_t>{kSpacing / 2, kSpacing / 2, 0}))
          << "nothing is in its way";
    }
  }
}

// What it could not move in this step, at most down to a site a step.
TEST(ACut, TakesVelocityFromAGrainThatIsFasterThanItCanMove) {
  for (const auto& [excess, left] :
       {std::pair(kSpacing / 4, 11 * kSpacing / 4), std::pair(3 * kSpacing, kSpacing)}) {
    Bench bench;
    bench.add({10, 20}, {0, -2 * kSpacing - excess}, {0, -3 * kSpacing, 7});
    bench.cut();
    EXPECT_EQ(bench.state.remainders[0].y, -2 * kSpacing);
    EXPECT_EQ(bench.state.velocities[0], (Velocity<std::int32_t>{0, -left, 7}));
  }
}

TEST(ACut, StopsAGrainOnTheFloor) {
  Bench bench;
  bench.add({10, 1}, kFarBelow, {300, -8000, 50});
  bench.cut();
  EXPECT_EQ(bench.state.velocities[0], (Velocity<std::int32_t>{300, 0, 50}));
}

TEST(ACut, OfAGrainThatGoesAwayChangesNoVelocity) {
  Bench bench;
  bench.add({10, 1}, kFarBelow, {300, 8000, 50});
  bench.add({20, 4}, {0, -kSpacing}, {0, -8000, 0});
  bench.cut();
  EXPECT_EQ(bench.state.velocities[0], (Velocity<std::int32_t>{300, 8000, 50}));
  EXPECT_EQ(bench.state.velocities[1], (Velocity<std::int32_t>{0, -8000, 0})) << "it is not cut";
}

TEST(ACut, GivesTwoGrainsTheVelocityOfBothTogether) {
  Bench bench;
  bench.add({10, 20}, kFarBelow, {0, -26'000, 0}, 0);  // 7 sites
  bench.add({10, 16}, {}, {}, 1);                      // 19 sites, 3 + 5 rows high together
  bench.cut();
  EXPECT_NEAR(bench.state.velocities[0].y, -7'000, 1);
  EXPECT_NEAR(bench.state.velocities[1].y, -7'000, 1);
}

// Three rods on a light grain: if each passed on its momentum as if it were alone, energy would
// grow.
TEST(Cuts, ThatMeetKeepMomentumAndGainNoEnergyInAnyOrder) {
  std::mt19937 random(7);
  const auto within = [&](std::int32_t most) {
    return std::uniform_int_distribution<std::int32_t>(-most, most)(random);
  };
  int changed = 0;
  for (int i = 0; i < 200; ++i) {
    Bench bench;
    const lattice::Site site = {15, 20};
    bench.add(site, {within(4 * kSpacing), within(4 * kSpacing)},
              {within(kSpacing / 2), within(kSpacing / 2), 0}, 0);
    for (const lattice::Axial lowest : {lattice::Axial{-1, 2}, {0, 2}, {1, 1}}) {
      bench.add(site + lowest, kFarBelow,
                {within(kSpacing / 4), -kSpacing / 2 + within(kSpacing / 2), 0}, 2);
    }
    const Eigen::Vector2d momentum = bench.momentum();
    const double energy = bench.energy();
    const State before = bench.state;
    Bench turned = bench;
    bench.cut();
    EXPECT_LE((bench.momentum() - momentum).norm(), 200);
    EXPECT_LE(bench.energy(), energy * (1 + 1e-6));
    changed += bench.state.velocities != before.velocities ? 1 : 0;
    std::vector<std::uint32_t> ids(before.velocities.size());
    std::iota(ids.rbegin(), ids.rend(), 0U);
    turned.cut(ids);
    EXPECT_EQ(turned.state, bench.state);
  }
  EXPECT_GT(changed, 150);
}

}  // namespace
}  // namespace clca::contact::cuts_test
