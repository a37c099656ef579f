#include "grains/internal/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include "support/states.hpp"

namespace clca::grains::separation_test {
namespace {

using lattice::Axial;
using lattice::Shape;

bool overlap(const Shape& first, const Shape& second, Axial apart) {
  return std::any_of(second.sites().begin(), second.sites().end(),
                     [&](Axial site) { return first.contains(site + apart); });
}

/// All paths of unit moves of the second, shortest first, until one leads out.
int searched_depth(const Shape& first, const Shape& second, Axial apart) {
  std::set<Axial> reached = {apart};
  for (int moves = 0;; ++moves) {
    std::set<Axial> next;
    for (const Axial at : reached) {
      if (!overlap(first, second, at)) {
        return moves;
      }
      for (const lattice::Direction direction : lattice::kDirections) {
        next.insert(at + unit(direction));
      }
    }
    reached = std::move(next);
  }
}

std::vector<Shape> odd_shapes() {
  const std::vector<Axial> corners = {{0, 0}, {3, 0}, {0, 3}};
  return {Shape::hexagon(0),
          Shape::hexagon(1),
          Shape::hexagon(2),
          Shape::rod(0, 5),
          Shape::rod(1, 3).rotated(1),
          Shape::polygon(corners).rotated(2),
          Shape({{0, 0}, {1, 0}, {2, 0}, {2, -1}, {2, -2}}),                   // a hook
          Shape({{0, 0}, {0, 1}, {1, 1}, {2, 0}, {3, -1}, {3, -2}, {2, -2}}),  // a horseshoe
          Shape({{4, 4}, {5, 4}, {6, 3}})};                                    // not about its site
}

template <class Visit>
void for_each_vector(int reach, Visit visit) {
  for (int x = -reach; x <= reach; ++x) {
    for (int q = -reach; q <= reach; ++q) {
      visit(Axial{x, q});
    }
  }
}

TEST(Separation, OfHexagonsIsTheSumOfTheRadiiLessTheDistance) {
  for (int one = 0; one < 4; ++one) {
    for (int other = 0; other < 4; ++other) {
      const SeparationTable table(Shape::hexagon(one), Shape::hexagon(other));
      for_each_vector(10, [&](Axial apart) {
        EXPECT_EQ(table.depth(apart), std::max(0, one + other + 1 - length(apart)));
      });
    }
  }
}

TEST(Separation, OfAnyTwoShapesIsTheShortestWayOut) {
  for (const Shape& first : odd_shapes()) {
    for (const Shape& second : odd_shapes()) {
      const SeparationTable table(first, second);
      for_each_vector(9, [&](Axial apart) {
        EXPECT_EQ(table.depth(apart), searched_depth(first, second, apart))
            << apart.x << ", " << apart.q;
      });
    }
  }
}

TEST(Separation, IsTheSameSeenFromEitherShape) {
  for (const Shape& first : odd_shapes()) {
    for (const Shape& second : odd_shapes()) {
      const SeparationTable table(first, second);
      const SeparationTable mirrored(second, first);
      for_each_vector(
          9, [&](Axial apart) { EXPECT_EQ(table.depth(apart), mirrored.depth(Axial{} - apart)); });
    }
  }
}

TEST(Separation, OfParticlesFollowsAShiftOfTheFirst) {
  State state = testing::empty_state(20, 20);
  state.kinds = {{Shape::hexagon(1), 0}, {Shape::hexagon(2), 1}};
  Separation separation(state);
  const Particle small = testing::particle_at(9, 10);
  const Particle large = testing::particle_at(9, 12, 1);
  EXPECT_EQ(separation.depth(small, large), 2);
  EXPECT_EQ(separation.depth(large, small), 2);
  EXPECT_EQ(separation.depth(small, large, {0, 1}), 3);
  EXPECT_EQ(separation.depth(small, large, {0, -1}), 1);
  EXPECT_EQ(separation.depth(small, large, {0, -2}), 0);
}

TEST(Separation, InAPeriodicBoxIsTakenTheNearerWayRound) {
  State state = testing::empty_state(10, 20);
  state.lattice = lattice::Lattice(10, 20, true);
  state.kinds = {{Shape::hexagon(1), 0}};
  Separation separation(state);
  const Particle left = testing::particle_at(0, 10);
  const Particle right = testing::particle_at(9, 10);
  EXPECT_EQ(separation.depth(left, right), 2);
  EXPECT_EQ(separation.depth(right, left), 2);
  const Particle laps_later = testing::particle_at(40, 10);
  EXPECT_EQ(separation.depth(left, laps_later), 3);
}

// Reference sites may be far apart where the bodies are not.
TEST(Separation, OfWideShapesCountsWhicheverImageOverlaps) {
  State state = testing::empty_state(10, 20);
  state.lattice = lattice::Lattice(10, 20, true);
  std::vector<Axial> leftwards;
  std::vector<Axial> rightwards;
  for (int x = 0; x < 7; ++x) {
    leftwards.push_back({-x, 0});
    rightwards.push_back({x, 0});
  }
  state.kinds = {{Shape(leftwards), 0}, {Shape(rightwards), 1}};
  Separation separation(state);
  const Particle one = testing::particle_at(8, 10);
  const Particle other = testing::particle_at(12, 7, 1);  // wrapped it begins in column 2
  // The first covers columns 2 to 8 and falls to the left by half a row a column: (2, 7) is its
  // end.
  EXPECT_EQ(separation.depth(one, other), 1);
  EXPECT_EQ(separation.depth(other, one), 1);
}

TEST(NearestVector, LeadsToAnImageOfTheSiteNoFartherThanHalfTheBox) {
  const lattice::Lattice box(12, 9, true);
  for (int from = -30; from < 30; ++from) {
    for (int to = -30; to < 30; ++to) {
      const lattice::Site start{from, 4};
      const lattice::Site goal{to, 6};
      const Axial way = nearest_vector(box, start, goal);
      const lattice::Site end = start + way;
      EXPECT_LE(std::abs(way.x), 6);
      EXPECT_EQ(end.row, goal.row);
      EXPECT_EQ(box.wrapped(end.column), box.wrapped(goal.column));
    }
  }
}

TEST(NearestVector, IsThePlainOneInABoxWithSides) {
  const lattice::Lattice box(12, 9, false);
  EXPECT_EQ(nearest_vector(box, {1, 4}, {11, 4}), (lattice::Site{11, 4} - lattice::Site{1, 4}));
}

}  // namespace
}  // namespace clca::grains::separation_test
