// Moves site by site, and what is left of them.

#include "contact/rule/moves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "contact/engine/engine.hpp"
#include "grains/internal/occupancy_table.hpp"
#include "support/states.hpp"

namespace clca::contact::moves_test {
namespace {

using lattice::Direction;
using testing::empty_state;
using testing::particle_at;

/// Hexagons of radius 1 that may move.
struct Bench {
  grains::State state = empty_state(30, 60);
  std::vector<Vector> remainders = {};

  Bench() { state.kinds = {{lattice::Shape::hexagon(1), 0}}; }
  void add(int column, int row, Vector remainder) {
    state.particles.push_back(particle_at(column, row));
    remainders.push_back(remainder);
  }
  /// By the rule and by the engine, which is given the grains in this order.
  std::vector<std::uint32_t> move(std::vector<std::uint32_t> ids = {}) {
    for (std::uint32_t id = 0; ids.size() < state.particles.size(); ++id) {
      ids.push_back(id);
    }
    State all{.grains = state,
              .remainders = remainders,
              .from_anchors = std::vector<lattice::Axial>(remainders.size())};
    State all_of_engine = all;
    grains::Box box(all.grains);
    grains::Box box_of_engine(all_of_engine.grains);
    SiteMoves moves(all, box);
    move_all(moves, all, Direction::down, {});
    Mover mover(all_of_engine, box_of_engine);
    mover.move_all(Direction::down, ids, {});
    EXPECT_EQ(all, all_of_engine);
    EXPECT_THAT(mover.site_moves().moved_ids(),
                ::testing::UnorderedElementsAreArray(moves.moved_ids()));
    state = all.grains;
    remainders = all.remainders;
    EXPECT_EQ(box.occupancy, grains::OccupancyTable(state));
    EXPECT_EQ(box_of_engine.occupancy, box.occupancy);
    return moves.moved_ids();
  }
};

constexpr Vector kDown = {0, -kSpacing * 3 / 4};

TEST(AColumn, AboveAFreedPlaceGoesAtOnceInWhateverOrderItsGrainsAreAsked) {
  for (const std::vector<std::uint32_t>& ids :
       {std::vector<std::uint32_t>{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}}) {
    Bench bench;
    for (int i = 0; i < 4; ++i) {
      bench.add(10, 5 + 3 * i, kDown);
    }
    EXPECT_THAT(bench.move(ids), ::testing::UnorderedElementsAre(0U, 1U, 2U, 3U));
    for (int i = 0; i < 4; ++i) {
      const auto id = static_cast<std::size_t>(i);
      EXPECT_EQ(bench.state.particles[id].row, 4 + 3 * i);
      EXPECT_EQ(bench.remainders[id], (Vector{0, kSpacing / 4}));
      EXPECT_EQ(bench.state.particles[id].previous, static_cast<grains::Move>(Direction::down));
    }
  }
}

// Each is in the way of the other, so neither can go first.
TEST(ShapesThatHook, IntoOneAnotherMoveAtOnceOrNotAtAll) {
  for (const bool both : {true, false}) {
    Bench bench;
    // One has an arm below and one above an arm of the other.
    bench.state.kinds = {
        {lattice::Shape({{0, 1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {-1, 2}}), 0},
        {lattice::Shape({{0, 0}, {1, 0}, {1, -1}}), 0}};
    bench.state.particles = {particle_at(10, 10, 0), particle_at(10, 10, 1)};
    bench.remainders = {kDown, both ? kDown : Vector()};
    const grains::OccupancyTable fits(bench.state);  // throws if not
    const std::vector<std::uint32_t> moved = bench.move();
    EXPECT_EQ(moved.size(), both ? 2U : 0U);
  }
}

TEST(AColumn, OnTheFloorStaysAndKeepsItsRemainders) {
  Bench bench;
  for (int i = 0; i < 4; ++i) {
    bench.add(10, 1 + 3 * i, kDown);
  }
  EXPECT_THAT(bench.move(), ::testing::IsEmpty());
  EXPECT_THAT(bench.remainders, ::testing::Each(kDown));
}

TEST(AGrain, ThatWaitsGoesInTheStepInWhichItsWayIsFree) {
  Bench bench;
  bench.add(10, 5, {});
  bench.add(10, 8, kDown);
  bench.add(10, 11, kDown);
  State all{.grains = bench.state,
            .remainders = bench.remainders,
            .from_anchors = std::vector<lattice::Axial>(bench.remainders.size())};
  grains::Box box(all.grains);
  Mover mover(all, box);
  const auto step = [&](const std::vector<std::uint32_t>& ids) {
    for (grains::Particle& grain : all.grains.particles) {
      grain.previous = grains::kRest;
    }
    mover.move_all(Direction::down, ids, {});
    return mover.site_moves().moved_ids();
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(step({0, 1, 2}), ::testing::IsEmpty());
  }
  all.remainders[0] = kDown;
  EXPECT_THAT(step({0, 1, 2}), ::testing::UnorderedElementsAre(0U, 1U, 2U));
  all.remainders[1] = kDown;
  EXPECT_THAT(step({0, 1, 2}), ::testing::IsEmpty());
  remove_particle(box, 0);
  mover.remove_grain(0);
  EXPECT_THAT(step({1, 2}), ::testing::ElementsAre(1U));
}

TEST(AGrain, MovesAsSoonAsItIsMoreThanHalfASiteAhead) {
  Bench bench;
  bench.add(10, 20, {0, -kSpacing / 2});
  bench.add(20, 20, {0, -kSpacing / 2 - 1});
  EXPECT_THAT(bench.move(), ::testing::ElementsAre(1U));
}

TEST(AGrain, MovesByOneSiteInEachDirectionThatItsRemainderAsksFor) {
  Bench bench;
  const auto far = static_cast<std::int32_t>(1.4 * kSpacing);
  bench.add(10, 20, {far, -far / 8});
  const auto moved = bench.move();
  ASSERT_FALSE(moved.empty());
  const Eigen::Vector2d gone =
      lattice::position(bench.state.particles[0].site()) - lattice::position(lattice::Site{10, 20});
  const Vector& left = bench.remainders[0];
  EXPECT_NEAR(gone.x() + static_cast<double>(left.x) / kSpacing, 1.4, 0x1p-18);
  EXPECT_NEAR(gone.y() + static_cast<double>(left.y) / kSpacing, -0.175, 0x1p-18);
}

TEST(TheDirections, ComeDownFirstAndUpLastWithSidesByACoin) {
  std::set<std::array<Direction, lattice::kDirectionCount>> seen;
  grains::State state = empty_state(4, 4);
  for (; state.step < 100; ++state.step) {
    const auto order = direction_order(state, Direction::down);
    EXPECT_EQ(order.front(), Direction::down);
    EXPECT_EQ(order.back(), Direction::up);
    EXPECT_EQ(std::set<Direction>(order.begin() + 1, order.begin() + 3),
              (std::set<Direction>{Direction::down_right, Direction::down_left}));
    seen.insert(order);
  }
  EXPECT_EQ(seen.size(), 4U);
}

constexpr UnitVector kGravity = {0, -(1 << kUnitBits)};

TEST(ARemainder, GrowsWithTheVelocityButForAGrainThatRests) {
  Vector remainder = {1600, 800};
  EXPECT_FALSE(advance_remainder(remainder, {100, -20, 0}, true, 50, kGravity));
  EXPECT_EQ(remainder, (Vector{1700, 780}));
  EXPECT_TRUE(advance_remainder(remainder, {30, 40, 900}, true, 50, kGravity))
      << "spin is no motion from the spot";
  EXPECT_EQ(remainder, (Vector{1700 - 106, 780 - 48}));
  EXPECT_FALSE(advance_remainder(remainder, {30, 40, 0}, false, 50, kGravity)) << "it flies";
  EXPECT_EQ(remainder, (Vector{1700 - 106 + 30, 780 - 48 + 40}));
}

TEST(ARemainder, IsKeptAlongGravityByRest) {
  Vector remainder = {1600, -3200};
  EXPECT_TRUE(advance_remainder(remainder, {}, true, 50, kGravity));
  EXPECT_EQ(remainder, (Vector{1500, -3200}));
  for (const Direction gravity : lattice::kDirections) {
    for (const Direction direction : lattice::kDirections) {
      remainder = {};
      subtract_along(remainder, -kSpacing / 3, direction);
      const std::int32_t before = along(remainder, unit_vector(gravity));
      EXPECT_TRUE(advance_remainder(remainder, {}, true, 50, unit_vector(gravity)));
      EXPECT_GE(along(remainder, unit_vector(gravity)), before - 1) << "rest lifts no grain";
    }
  }
}

TEST(ARemainder, StaysInRange) {
  Vector remainder = {kMaxRemainder, -kMaxRemainder};
  advance_remainder(remainder, {kMaxVelocity, -kMaxVelocity, 0}, true, 50, kGravity);
  EXPECT_EQ(remainder, (Vector{kMaxRemainder, -kMaxRemainder}));
}

}  // namespace
}  // namespace clca::contact::moves_test
