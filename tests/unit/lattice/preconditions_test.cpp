// What cannot be put on a lattice is refused.

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::lattice::preconditions_test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kHuge = std::numeric_limits<int>::max();

TEST(ABox, HasASizeThatIsPositiveAndFinite) {
  for (const double wrong : {0.0, -1.0, kNaN, kInfinity, 1e12}) {
    EXPECT_THROW(Lattice::covering(wrong, 10, false), std::invalid_argument) << wrong;
    EXPECT_THROW(Lattice::covering(10, wrong, true), std::invalid_argument) << wrong;
  }
}

TEST(ARectangle, HasEdgesThatAreNumbers) {
  const Lattice lattice(10, 10, false);
  EXPECT_THROW(sites_in(lattice, {0, kNaN, 5, 5}), std::invalid_argument);
  EXPECT_EQ(sites_in(lattice, {-kInfinity, -kInfinity, kInfinity, kInfinity}).size(), 100U);
}

TEST(AStraightWall, HasEndsNearbyAndAThickness) {
  const Lattice lattice(10, 10, false);
  EXPECT_THROW(sites_along(lattice, {{0, kNaN}, {5, 5}, 1}), std::invalid_argument);
  EXPECT_THROW(sites_along(lattice, {{0, 0}, {kInfinity, 5}, 1}), std::invalid_argument);
  EXPECT_THROW(sites_along(lattice, {{0, 0}, {5, 5}, -1}), std::invalid_argument);
  EXPECT_THROW(sites_along(lattice, {{0, 0}, {5, 5}, kNaN}), std::invalid_argument);
}

TEST(ANearestSite, IsThatOfAPointNearby) {
  EXPECT_THROW(nearest_site({kNaN, 0}), std::invalid_argument);
  EXPECT_THROW(nearest_site({0, 1e300}), std::invalid_argument);
}

TEST(AShape, StaysWithinReach) {
  EXPECT_THROW(Shape({{kHuge, 0}}), std::invalid_argument);
  EXPECT_THROW(Shape::hexagon(kHuge), std::invalid_argument);
  EXPECT_THROW(Shape::hexagon(-1), std::invalid_argument);
  EXPECT_THROW(Shape::rod(0, 0), std::invalid_argument);
  EXPECT_THROW(Shape::rod(0, kHuge), std::invalid_argument);
  const std::vector<Axial> corners = {{0, 0}, {-kHuge, 0}, {0, kHuge}};
  EXPECT_THROW(Shape::polygon(corners), std::invalid_argument);
}

TEST(Offsets, ThatDoNotFitInto32BitsAreRefused) {
  const Lattice tall = Lattice::covering(10, 1e9, true);
  EXPECT_EQ(tall.index_offset({2, -1}, false).index,
            2'000'000'128);  // rows are rounded up to words
  EXPECT_THROW(tall.index_offset({4, 0}, false), std::invalid_argument);
  EXPECT_THROW(tall.index_offset({-4, 0}, false), std::invalid_argument);
}

}  // namespace
}  // namespace clca::lattice::preconditions_test
