#include "clca/render/space_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clca/render/painter.hpp"
#include "packed_state.hpp"
#include "render/colors.hpp"
#include "support/missing.hpp"

namespace clca::render::space_time_test {
namespace {

/// A line of two places.
Eigen::ArrayXXd line(double low, double high) {
  Eigen::ArrayXXd values(1, 2);
  values << low, high;
  return values;
}

TEST(TimeMeans, HoldsEachLineAsLongAsItLasts) {
  TimeMeans means(10, 2, 1, 100, 200);
  means.add(100, 130, line(1, 5));
  means.add(130, 200, line(2, 6));
  for (int column = 0; column < 10; ++column) {
    EXPECT_NEAR(means.mean(column, 0)[0], column < 3 ? 1 : 2, 1e-12) << column;
    EXPECT_NEAR(means.mean(column, 1)[0], column < 3 ? 5 : 6, 1e-12) << column;
  }
}

TEST(TimeMeans, ManyLinesInAPixelCountByTheirTime) {
  TimeMeans means(2, 2, 1, 0, 20);
  means.add(0, 2, line(1, 0));
  means.add(2, 3, line(4, 0));
  means.add(3, 14, line(10, 0));
  EXPECT_NEAR(means.mean(0, 0)[0], (2 * 1 + 1 * 4 + 7 * 10) / 10.0, 1e-12);
  EXPECT_NEAR(means.mean(1, 0)[0], 10, 1e-12);  // of what is known
}

TEST(TimeMeans, KnowsWhereThereIsNothing) {
  TimeMeans means(4, 2, 1, 0, 4);
  means.add(-5, 2, line(1, 1));
  means.add(4, 4, line(1, 1));
  means.add(4, 9, line(1, 1));
  EXPECT_TRUE(means.is_known(0));
  EXPECT_TRUE(means.is_known(1));
  EXPECT_FALSE(means.is_known(2));
  EXPECT_FALSE(means.is_known(3));
}

TEST(LineColors, AreThoseOfParticlesAndWallsAndWhiteElsewhere) {
  grains::State state = empty_state(20, 30, false);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  state.particles = {{.column = 8, .row = 10, .kind = 0}};
  state.origins = {{8, 10}};
  state.walls = {{lattice::sites_in(state.lattice, {0, 3, 20, 4}), true}};
  const Coloring coloring = color_by_id();
  const double x = lattice::kColumnPitch * 8;
  const std::vector<Eigen::Vector2d> points = {{x, 10},  {x, 11.4}, {x, 11.6},
                                               {x, 3.4}, {x, -7},   {-5, 10}};
  const grains::Occupancy occupancy(state);
  const LineColors seen = line_colors(state, occupancy, coloring, points);
  const Rgb grain = color(coloring, state, occupancy, 0);
  EXPECT_EQ(seen.colors, (std::vector<Rgb>{grain, grain, kPaper, kWallColor, kPaper, kPaper}));
  EXPECT_TRUE(seen.walls.standing);
  EXPECT_FALSE(seen.walls.moving);
}

TEST(LineColors, GoOnAcrossThePeriodicSeam) {
  grains::State state = empty_state(20, 30, true);
  state.kinds = {{lattice::Shape::hexagon(2), 0}};
  state.particles = {{.column = 0, .row = 10, .kind = 0}};
  state.origins = {{0, 10}};
  const double width = lattice::kColumnPitch * 20;
  const std::vector<Eigen::Vector2d> points = {{-1, 10}, {width - 1, 10}, {width, 10}};
  const LineColors seen = line_colors(state, grains::Occupancy(state), color_by_id(), points);
  EXPECT_NE(seen.colors[0], kPaper);
  EXPECT_EQ(seen.colors[0], seen.colors[1]);
  EXPECT_EQ(seen.colors[0], seen.colors[2]);
}

TimePlot plot_of(int width, int height) {
  return {.width = width,
          .height = height,
          .title = "Title",
          .time = {"step", 0, 100},
          .position = {"height", 0, 50},
          .stages = {{"first", 0}, {"second", 40}},
          .legend = {}};
}

constexpr Rgb kContent = {10, 200, 30};

TEST(TimePicture, ShowsItsContentBetweenTheAxes) {
  if (const std::string problem = font_problem(); !problem.empty()) {
    CLCA_SKIP_AS_MISSING(problem);
  }
  const TimePlot plot = plot_of(800, 500);
  const PixelBox panel = time_panel(plot);
  const Image image = time_picture(plot, Image(panel.width, panel.height, kContent));
  EXPECT_EQ(image.width, 800);
  EXPECT_EQ(image.height, 500);
  for (const int x : {panel.x, panel.x + panel.width - 1}) {
    EXPECT_EQ(image.at(x, panel.y), kContent);
    EXPECT_EQ(image.at(x, panel.y + panel.height - 1), kContent);
  }
  EXPECT_EQ(image.at(panel.x - 1, panel.y), kInk);
  EXPECT_EQ(image.at(panel.x, panel.y + panel.height), kInk);
  const int boundary = panel.x + static_cast<int>(0.4 * panel.width);
  int lines = 0;
  for (int x = boundary - 2; x <= boundary + 2; ++x) {
    lines += image.at(x, panel.y + 5) == kInk ? 1 : 0;
  }
  EXPECT_EQ(lines, 1);
}

TEST(TimePicture, WithoutAnnotationsTheContentFillsIt) {
  TimePlot plot = plot_of(80, 50);
  plot.annotations = false;
  EXPECT_EQ(time_panel(plot), (PixelBox{0, 0, 80, 50}));
  const Image image = time_picture(plot, Image(80, 50, kContent));
  EXPECT_EQ(image.at(0, 0), kContent);
  EXPECT_EQ(image.at(79, 49), kContent);
}

TEST(TimePicture, HasAPanelAtAnySize) {
  for (const int width : {16, 72, 100, 5000}) {
    for (const int height : {16, 103, 120, 3000}) {
      const PixelBox panel = time_panel(plot_of(width, height));
      EXPECT_GT(panel.width, 0) << width << " x " << height;
      EXPECT_GT(panel.height, 0) << width << " x " << height;
    }
  }
}

}  // namespace
}  // namespace clca::render::space_time_test
