#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "clca/lattice/region.hpp"

namespace clca::lattice::swept_region_test {
namespace {

struct Way {
  Direction direction = Direction::up;
  int low = 0;
  int high = 0;
};

std::vector<Way> ways() {
  std::vector<Way> all;
  for (const Direction direction : kDirections) {
    for (const auto& [low, high] : {std::pair(0, 0), {0, 9}, {-3, 3}, {-30, 40}, {5, 7}}) {
      all.push_back({direction, low, high});
    }
  }
  return all;
}

/// Tries every step.
bool comes_in(const Lattice& lattice, const Way& way, Site site) {
  if (lattice.periodic() && (site.column < 0 || site.column >= lattice.columns())) {
    return false;
  }
  const Axial step = unit(way.direction);
  for (int i = way.low; i <= way.high; ++i) {
    if (lattice.contains(site + Axial{i * step.x, i * step.q})) {
      return true;
    }
  }
  return false;
}

/// A square of sites well beyond what any of the ways reaches.
template <class Visit>
void for_each_site(Visit visit) {
  for (int column = -60; column < 70; ++column) {
    for (int row = -60; row < 70; ++row) {
      visit(Site{column, row});
    }
  }
}

std::vector<Lattice> boxes() {
  return {{10, 8, false}, {7, 1, false}, {1, 6, false}, {10, 8, true}, {2, 5, true}};
}

}  // namespace

TEST(SweptRegion, HoldsTheSitesThatSomeStepBringsIntoTheBox) {
  for (const Lattice& lattice : boxes()) {
    for (const Way& way : ways()) {
      const SweptRegion swept_region(lattice, way.direction, way.low, way.high);
      const RowRange all = swept_region.enclosing_rows();
      for_each_site([&](Site site) {
        const bool inside = comes_in(lattice, way, site);
        ASSERT_EQ(swept_region.contains(site), inside)
            << site.column << ", " << site.row << " by " << way.low << " to " << way.high
            << " in direction " << index_of(way.direction) << (lattice.periodic() ? " round" : "");
        ASSERT_TRUE(!inside || (all.first_row <= site.row && site.row < all.end_row));
      });
    }
  }
}

TEST(SweptRegion, WithoutStepsIsTheBox) {
  const Lattice lattice(10, 8, false);
  const SweptRegion box(lattice);
  for_each_site([&](Site site) { EXPECT_EQ(box.contains(site), lattice.contains(site)); });
}

TEST(SweptRegion, HoldsTheSitesOfARectangleThatComeIn) {
  const Rectangle rectangle = {-9.3, -12, 14, 21.5};
  for (const Lattice& lattice : boxes()) {
    for (const Way& way : ways()) {
      std::vector<Site> expected;
      for_each_site([&](Site site) {
        if (rectangle.contains(position(site)) && comes_in(lattice, way, site)) {
          expected.push_back(site);
        }
      });
      EXPECT_EQ(sites_in(SweptRegion(lattice, way.direction, way.low, way.high), rectangle),
                expected);
    }
  }
}

TEST(SweptRegion, HoldsTheSitesOfALineThatComeIn) {
  const Lattice box(10, 8, false);
  const Lattice plane(200, 200, false);  // far to the upper right, to see the line uncut
  for (const Segment& line :
       {Segment{{-20.2, -30.3}, {25.1, 30.2}, 1}, Segment{{3, -40}, {3, 40}, 4},
        Segment{{-25, 12}, {30, 12}, 0}, Segment{{-4, -3}, {-2, 20}, 2.5}}) {
    for (const Way& way : ways()) {
      const Site corner = {-100, -100};
      const Eigen::Vector2d shift = -position(corner);
      std::vector<Site> expected;
      for (const Site site :
           sites_along(plane, {line.from + shift, line.to + shift, line.thickness})) {
        const Site home = {site.column + corner.column, site.row + corner.row};
        if (comes_in(box, way, home)) {
          expected.push_back(home);
        }
      }
      EXPECT_EQ(sites_along(SweptRegion(box, way.direction, way.low, way.high), line), expected);
    }
  }
}

TEST(SweptRegion, OfAHighPlateIsNoHigherThanItsWay) {
  const Lattice lattice(100, 50, false);
  const SweptRegion swept_region(lattice, Direction::down, 0, 40);
  EXPECT_EQ(sites_in(swept_region, Rectangle{0, 0, 5, 1e6}).size(), 6U * 90U);
  EXPECT_LT(sites_along(swept_region, Segment{{5, 0}, {5, 1e6}, 1}).size(), 200U);
}

}  // namespace clca::lattice::swept_region_test
