#include "clca/lattice/picture.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

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

TEST(Picture, NeedsPixels) {
  EXPECT_THROW(sites_in(kBox, Picture{.box = {0, 0, 1, 1}, .rows = {}}), std::invalid_argument);
  EXPECT_THROW(sites_in(kBox, Picture{.box = {0, 0, 1, 1}, .rows = {"#", ""}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace clca::lattice::picture_test
