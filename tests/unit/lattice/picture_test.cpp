#include <gtest/gtest.h>

#include <stdexcept>

#include "clca/lattice/region.hpp"

namespace clca::lattice::picture_test {
namespace {

const SweptRegion kBox(Lattice(10, 10, false));

TEST(Picture, ASiteTakesThePixelThatItFallsOn) {
  // 4 x 2 pixels of 2 x 4 spacings.
  const Picture picture = {.box = {0, 0, 8, 8}, .rows = {"#..#", ".#.."}};
  const auto sites = sites_in(kBox, picture);
  EXPECT_EQ(sites.size(), 10U + 11U + 9U);
  for (const Site site : sites) {
    const Eigen::Vector2d at = position(site);
    EXPECT_TRUE(at.y() > 4 ? at.x() < 2 || at.x() >= 6 : at.x() >= 2 && at.x() < 4)
        << at.x() << " " << at.y();
  }
}

TEST(Picture, WhatIsOutsideTheBoxIsLeftOut) {
  const Picture picture = {.box = {-100, -100, 2, 2}, .rows = {"#"}};
  EXPECT_EQ(sites_in(kBox, picture), sites_in(kBox, Rectangle{0, 0, 2, 2}));
  EXPECT_TRUE(holds_no_site(Lattice(10, 10, false), {.box = {-9, -9, 0, 0}, .rows = {"#"}}));
  EXPECT_TRUE(holds_no_site(Lattice(10, 10, false), {.box = {0, 0, 9, 9}, .rows = {"."}}));
  EXPECT_FALSE(holds_no_site(Lattice(10, 10, false), picture));
}

TEST(Picture, HoldsASiteIfThereIsOne) {
  const std::vector<std::string> pixels = {"#.......", ".......#", "...#....", "........",
                                           "....#..."};
  const Lattice small(6, 5, false);
  int empty = 0;
  for (int i = 0; i < 400; ++i) {
    const double left = 0.37 * (i % 20) - 2;
    const double bottom = 0.29 * (i / 20) - 1;
    const Picture picture = {.box = {left, bottom, left + 3, bottom + 2}, .rows = pixels};
    const bool holds_none = sites_in(SweptRegion(small), picture).empty();
    EXPECT_EQ(holds_no_site(small, picture), holds_none) << left << " " << bottom;
    empty += holds_none ? 1 : 0;
  }
  EXPECT_GT(empty, 100);
  EXPECT_LT(empty, 300);
  const Lattice large = Lattice::covering(8e5, 1e6, false);  // the sites of which fit nowhere
  EXPECT_FALSE(holds_no_site(large, {.box = {0, 0, 8e5, 1e6}, .rows = pixels}));
  EXPECT_TRUE(holds_no_site(large, {.box = {0, 0, 8e5, 1e6}, .rows = {"..", ".."}}));
}

TEST(Picture, NeedsPixels) {
  EXPECT_THROW(sites_in(kBox, Picture{.box = {0, 0, 1, 1}, .rows = {}}), std::invalid_argument);
  EXPECT_THROW(sites_in(kBox, Picture{.box = {0, 0, 1, 1}, .rows = {"#", ""}}),
               std::invalid_argument);
  EXPECT_THROW(sites_in(kBox, Picture{.box = {0, 0, 1, 1}, .rows = {"#", "##"}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace clca::lattice::picture_test
