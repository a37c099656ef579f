#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "clca/lattice/region.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::lattice::lattice_test {
namespace {

TEST(Direction, SixUnitStepsHaveLengthOneAndLieSixtyDegreesApart) {
  for (const Direction direction : kDirections) {
    EXPECT_EQ(length_in_steps(unit(direction)), 1);
    EXPECT_NEAR(position(unit(direction)).norm(), 1, 1e-12);
    EXPECT_NEAR(position(unit(direction)).dot(position(unit(rotated(direction, 1)))), 0.5, 1e-12);
    EXPECT_EQ(rotated_clockwise(unit(direction)), unit(rotated(direction, 1)));
    EXPECT_EQ(unit(direction) + unit(opposite(direction)), (Axial{0, 0}));
  }
}

TEST(Site, StepsFromEvenAndOddColumnsAgreeWithCartesianGeometry) {
  for (const Site from : {Site{4, 7}, Site{5, 7}, Site{-3, 2}, Site{-4, 2}}) {
    for (const Direction direction : kDirections) {
      const Site to = from + unit(direction);
      EXPECT_NEAR((position(to) - position(from) - position(unit(direction))).norm(), 0, 1e-12);
      EXPECT_EQ(to - from, unit(direction));
    }
  }
}

TEST(Lattice, OffsetsLeadToTheSameMemoryAsSites) {
  for (const bool periodic : {false, true}) {
    const Lattice lattice(10, 130, periodic);
    for (const Site site : {Site{0, 3}, Site{1, 64}, Site{8, 129}, Site{9, 0}}) {
      for (const Axial vector : {Axial{1, 0}, Axial{-1, 1}, Axial{0, -1}, Axial{1, -1}}) {
        const IndexOffset offset = lattice.index_offset(vector, is_odd(site.column));
        EXPECT_EQ(lattice.shifted_index(lattice.index(site), site.column, offset),
                  lattice.index(site + vector));
      }
      for (const int columns : {-34, -20, 13, 30}) {  // more than once around
        const Axial vector = {columns, -columns / 2};
        const IndexOffset offset = lattice.index_offset(vector, is_odd(site.column));
        if (periodic) {
          EXPECT_EQ(lattice.shifted_index(lattice.index(site), site.column, offset),
                    lattice.index(site + vector));
        }
      }
    }
  }
}

TEST(Lattice, MemoryPlacesAndSitesCorrespondOneToOne) {
  const Lattice lattice(5, 7, false);
  std::set<std::size_t> places;
  for (int column = -1; column <= 5; ++column) {
    for (int row = -1; row <= 7; ++row) {
      const std::size_t place = lattice.index({column, row});
      EXPECT_LT(place, lattice.index_count());
      EXPECT_EQ(lattice.site(place), (Site{column, row}));
      places.insert(place);
    }
  }
  EXPECT_EQ(places.size(), 7U * 9U);
}

TEST(Lattice, WhatIsNearInTwoColumnsIsNearInMemory) {
  const Lattice lattice(5, 100, false);
  EXPECT_EQ(lattice.index({2, 7}), lattice.index({1, 7}) + 1);
  EXPECT_EQ(lattice.index({1, 8}), lattice.index({1, 7}) + Lattice::kRowStride);
}

TEST(Lattice, CoversTheAskedWidthAndHeight) {
  const Lattice lattice = Lattice::covering(300, 200, false);
  EXPECT_EQ(lattice.columns(), 347);  // ceil(300 / 0.8660)
  EXPECT_EQ(lattice.rows(), 200);
  EXPECT_EQ(Lattice::covering(300, 200, true).columns(), 348);  // even
}

TEST(Lattice, RefusesBoxesThatCannotBe) {
  EXPECT_THROW(Lattice(0, 5, false), std::invalid_argument);
  EXPECT_THROW(Lattice(5, 0, false), std::invalid_argument);
  EXPECT_THROW(Lattice(5, 5, true), std::invalid_argument);
}

TEST(Shape, HexagonsHaveTheCentredHexagonalNumbersOfSites) {
  for (int radius = 0; radius < 8; ++radius) {
    EXPECT_EQ(Shape::hexagon(radius).size(),
              static_cast<std::size_t>(3 * radius * (radius + 1) + 1));
  }
}

TEST(Shape, LooksOfSmallHexagonsAreThreeAndFive) {
  for (const Direction direction : kDirections) {
    EXPECT_EQ(Shape::hexagon(1).lead_sites(direction).size(), 3U);
    EXPECT_EQ(Shape::hexagon(2).lead_sites(direction).size(), 5U);
    EXPECT_EQ(Shape::hexagon(2).trail_sites(direction).size(), 5U);
  }
}

TEST(Shape, LeadAndTrailTurnAShapeIntoItsImageOneStepOn) {
  const Shape shape({{0, 0}, {1, 0}, {2, 0}, {2, -1}, {0, 1}});
  for (const Direction direction : kDirections) {
    std::vector<Axial> moved = shape.sites();
    const auto lead = shape.lead_sites(direction);
    moved.insert(moved.end(), lead.begin(), lead.end());
    for (const Axial site : shape.trail_sites(direction)) {
      std::erase(moved, site);
    }
    std::vector<Axial> image;
    for (const Axial site : shape.sites()) {
      image.push_back(site + unit(direction));
    }
    EXPECT_THAT(moved, ::testing::UnorderedElementsAreArray(image));
  }
}

TEST(Shape, PolygonTakesAllSitesOnAndInsideItsOutline) {
  const std::vector<Axial> hexagon = {{0, 2}, {2, 0}, {2, -2}, {0, -2}, {-2, 0}, {-2, 2}};
  EXPECT_EQ(Shape::polygon(hexagon), Shape::hexagon(2));
  const std::vector<Axial> triangle = {{0, 0}, {4, 0}, {0, 4}};
  EXPECT_EQ(Shape::polygon(triangle).size(), 15U);
}

TEST(Shape, RodOfRadiusZeroIsALineOfSites) {
  EXPECT_EQ(Shape::rod(0, 4).sites(), (std::vector<Axial>{{0, 0}, {0, 1}, {0, 2}, {0, 3}}));
  EXPECT_EQ(Shape::rod(1, 4).size(), 7U + 3U * 3U);
}

TEST(Shape, SixTurnsGiveTheShapeBackAndHexagonsNeverChange) {
  const Shape rod = Shape::rod(0, 3);
  EXPECT_EQ(rod.rotated(6), rod);
  EXPECT_EQ(rod.rotated(-1), rod.rotated(5));
  EXPECT_TRUE(rod.is_congruent(rod.rotated(3)));
  EXPECT_FALSE(rod.is_congruent(rod.rotated(1)));
  EXPECT_EQ(Shape::hexagon(3).rotated(1), Shape::hexagon(3));
}

TEST(Shape, RefusesWhatIsNoShape) {
  EXPECT_THROW(Shape({}), std::invalid_argument);
  EXPECT_THROW(Shape({{0, 0}, {0, 0}}), std::invalid_argument);
  EXPECT_THROW(Shape({{0, 0}, {2, 0}}), std::invalid_argument);  // not connected
  std::vector<Axial> ring = Shape::hexagon(1).sites();
  std::erase(ring, Axial{0, 0});
  EXPECT_THROW(Shape{ring}, std::invalid_argument);  // a hole
}

TEST(Region, RectangleTakesLeftAndBottomEdgesAndLeavesTheOthers) {
  const Lattice lattice(10, 10, false);
  EXPECT_THAT(sites_in(lattice, {0, 0, 0.5, 3}),
              ::testing::ElementsAre(Site{0, 0}, Site{0, 1}, Site{0, 2}));
  EXPECT_TRUE(sites_in(lattice, {0.1, 0, 0.8, 3}).empty());
  EXPECT_EQ(sites_in(lattice, {-1e300, -1e300, 1e300, 1e300}).size(), 100U);
}

TEST(Region, SlantedWallsOfAnyAngleLetNothingThrough) {
  const Lattice lattice(40, 40, false);
  for (int angle = 0; angle < 180; angle += 7) {
    const double radians = angle * 3.14159265358979 / 180;
    const Eigen::Vector2d along(std::cos(radians), std::sin(radians));
    const Eigen::Vector2d middle(17, 20);
    const auto wall = sites_along(lattice, {middle - 60 * along, middle + 60 * along, 0.1});
    const std::set<Site> blocked(wall.begin(), wall.end());
    // Flood from one side; the other must stay dry.
    const Eigen::Vector2d across(-along.y(), along.x());
    const Site start = nearest_site(middle + 8 * across);
    const Site beyond = nearest_site(middle - 8 * across);
    std::set<Site> wet = {start};
    std::vector<Site> open = {start};
    while (!open.empty()) {
      const Site site = open.back();
      open.pop_back();
      for (const Direction direction : kDirections) {
        const Site next = site + unit(direction);
        if (lattice.contains(next) && !blocked.contains(next) && wet.insert(next).second) {
          open.push_back(next);
        }
      }
    }
    EXPECT_FALSE(wet.contains(beyond)) << "wall at " << angle << " degrees";
  }
}

TEST(Region, ThickWallsTakeAllSitesWithinHalfTheirThickness) {
  const Lattice lattice(40, 40, false);
  const auto wall = sites_along(lattice, {{5, 20}, {25, 20}, 4});
  EXPECT_TRUE(std::find(wall.begin(), wall.end(), nearest_site({15, 21.5})) != wall.end());
  EXPECT_TRUE(std::find(wall.begin(), wall.end(), nearest_site({15, 23.5})) == wall.end());
}

TEST(Region, NearestSiteIsTheNearest) {
  for (double x = 0; x < 5; x += 0.37) {
    for (double y = 0; y < 5; y += 0.41) {
      const Eigen::Vector2d point(x, y);
      const double found = (position(nearest_site(point)) - point).norm();
      for (int column = 0; column < 8; ++column) {
        for (int row = 0; row < 8; ++row) {
          EXPECT_LE(found, (position(Site{column, row}) - point).norm() + 1e-12);
        }
      }
    }
  }
}

TEST(Lattice, APlaceOfAPeriodicBoxIsBroughtIntoIt) {
  const Lattice periodic(10, 10, true);
  const double width = periodic.extent().x();
  const double left = Lattice::lower_left_corner().x();
  EXPECT_EQ(periodic.image_in_box({3, 50}), Eigen::Vector2d(3, 50));
  EXPECT_EQ(periodic.image_in_box({left, 1}).x(), left);
  EXPECT_NEAR(periodic.image_in_box({left + width, 1}).x(), left, 1e-12);
  EXPECT_NEAR(periodic.image_in_box({3 + 7 * width, 1}).x(), 3, 1e-12);
  EXPECT_NEAR(periodic.image_in_box({3 - 7 * width, 1}).x(), 3, 1e-12);
  EXPECT_EQ(Lattice(10, 10, false).image_in_box({-50, 1}), Eigen::Vector2d(-50, 1));
  for (int image = -1000; image <= 1000; ++image) {
    for (const double beside : {-1e-15, -1e-16, 0.0, 1e-16, 1e-15}) {
      const double x = periodic.image_in_box({left + image * width + beside, 1}).x();
      EXPECT_GE(x, left);
      EXPECT_LT(x, left + width);
    }
  }
}

TEST(NearestVector, LeadsToAnImageOfTheSiteNoFartherThanHalfTheBox) {
  const Lattice box(12, 9, true);
  for (int from = -30; from < 30; ++from) {
    for (int to = -30; to < 30; ++to) {
      const Site start{from, 4};
      const Site goal{to, 6};
      const Axial way = box.shortest_vector(start, goal);
      const Site end = start + way;
      EXPECT_LE(std::abs(way.x), 6);
      EXPECT_EQ(end.row, goal.row);
      EXPECT_EQ(box.wrapped(end.column), box.wrapped(goal.column));
    }
  }
}

TEST(NearestVector, IsThePlainOneInABoxWithSides) {
  const Lattice box(12, 9, false);
  EXPECT_EQ(box.shortest_vector({1, 4}, {11, 4}), (Site{11, 4} - Site{1, 4}));
}

}  // namespace
}  // namespace clca::lattice::lattice_test
