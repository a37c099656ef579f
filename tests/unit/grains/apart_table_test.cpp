#include "grains/internal/apart_table.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace clca::grains::apart_table_test {
namespace {

using lattice::Axial;

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
}  // namespace clca::grains::apart_table_test
