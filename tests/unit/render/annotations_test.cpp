#include "render/annotations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "clca/render/coloring.hpp"
#include "packed_state.hpp"
#include "support/missing.hpp"

namespace clca::render::annotations_test {
namespace {

class Annotations : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string problem = font_warning(); !problem.empty()) {
      CLCA_SKIP_AS_MISSING(problem);
    }
  }
};

bool blank(const Image& image, int top, int bottom) {
  for (int y = top; y < bottom; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) != Rgb{255, 255, 255}) {
        return false;
      }
    }
  }
  return true;
}

TEST(RoundLength, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(largest_round_number_up_to(1), 1);
  EXPECT_DOUBLE_EQ(largest_round_number_up_to(1.99), 1);
  EXPECT_DOUBLE_EQ(largest_round_number_up_to(4.9), 2);
  EXPECT_DOUBLE_EQ(largest_round_number_up_to(73), 50);
  EXPECT_DOUBLE_EQ(largest_round_number_up_to(0.3), 0.2);
}

TEST(LengthUnit, MakesTheNumberOneOrMore) {
  EXPECT_STREQ(length_unit(20).name, "m");
  EXPECT_STREQ(length_unit(0.5).name, "mm");
  EXPECT_STREQ(length_unit(0.001).name, "mm");
  EXPECT_STREQ(length_unit(0.0002).name, "µm");
  EXPECT_EQ(0.0002 * length_unit(0.0002).per_metre, 200);
}

TEST(Ticks, AreFewAndRound) {
  EXPECT_EQ(tick_values(0, 40, 6), (std::vector<double>{0, 10, 20, 30, 40}));
  EXPECT_EQ(tick_values(3, 3, 6), (std::vector<double>{3}));
  EXPECT_LE(tick_values(1e17, 1e17 + 32, 6).size(), 6U);
  for (const double high : {0.07, 1.0, 3.3, 9.0, 11.0, 99.0, 12345.0}) {
    const std::vector<double> values = tick_values(0, high, 6);
    EXPECT_GE(values.size(), 2U) << high;
    EXPECT_LE(values.size(), 6U) << high;
    EXPECT_LE(values.back(), high * (1 + 1e-6));
  }
}

TEST(Layout, GivesTheWholePictureToTheViewWithoutAnnotations) {
  const Layout layout = layout_of(400, 300, {0, 0, 40, 30}, render::Annotations::none);
  EXPECT_EQ(layout.panel.width, 400);
  EXPECT_EQ(layout.panel.height, 300);
  EXPECT_DOUBLE_EQ(layout.pixels_per_spacing, 10);
  EXPECT_EQ(layout.text_size, 0);
}

TEST(Layout, KeepsTheViewInsideThePicture) {
  for (const int width : {1, 50, 300, 1280}) {
    for (const int height : {1, 40, 200, 720}) {
      for (const double aspect : {0.001, 0.3, 1.0, 7.0, 5000.0}) {
        const PixelBox panel =
            layout_of(width, height, {0, 0, aspect, 1}, render::Annotations::all).panel;
        EXPECT_GE(panel.x, 0);
        EXPECT_GE(panel.y, 0);
        EXPECT_LE(panel.x + panel.width, width);
        EXPECT_LE(panel.y + panel.height, height);
      }
    }
  }
}

TEST(Layout, TextIsAsLargeAsThePictureIsHighAndWide) {
  const lattice::Rectangle view = {0, 0, 30, 20};
  const int wide = layout_of(1280, 720, view, render::Annotations::all).text_size;
  EXPECT_EQ(layout_of(3840, 2160, view, render::Annotations::all).text_size, 3 * wide);
  EXPECT_EQ(layout_of(2000, 720, view, render::Annotations::all).text_size, wide);
  EXPECT_EQ(layout_of(900, 720, view, render::Annotations::all).text_size, wide);
  EXPECT_LT(layout_of(720, 720, view, render::Annotations::all).text_size, wide);
  const Layout upright = layout_of(720, 1280, view, render::Annotations::all);
  EXPECT_LT(upright.text_size, wide);
  EXPECT_GE(upright.text_right - upright.text_left, 44 * upright.text_size);
  // A tall view is narrower than its caption.
  const Layout tall = layout_of(1280, 720, {0, 0, 10, 40}, render::Annotations::all);
  EXPECT_LT(tall.text_left, tall.panel.x);
  EXPECT_EQ(tall.text_right - tall.text_left, 44 * tall.text_size);
}

TEST(LegendLines, TakeASecondLineBeforeTheyGiveUp) {
  const std::vector<double> widths(4, 10.0);
  const std::vector<double> rooms = {25, 40};
  const auto lines = [&](std::size_t count) {
    return placed_legend_items(std::span(widths).first(count), 3, 1, rooms);
  };
  EXPECT_TRUE(lines(0).empty());
  EXPECT_EQ(lines(2), (std::vector<LegendItem>{{0, 0, 0}, {1, 11, 0}}));
  EXPECT_EQ(lines(4), (std::vector<LegendItem>{{0, 0, 0}, {1, 11, 0}, {2, 0, 1}, {3, 11, 1}}));
}

TEST(LegendLines, LeaveOutThoseBeforeTheLast) {
  const std::vector<double> widths(9, 10.0);
  const std::vector<double> rooms = {25, 25};
  EXPECT_EQ(placed_legend_items(widths, 3, 1, rooms),
            (std::vector<LegendItem>{
                {0, 0, 0}, {1, 11, 0}, {2, 0, 1}, {std::nullopt, 11, 1}, {8, 15, 1}}));
  const std::vector<double> narrow = {4, 4};
  EXPECT_EQ(placed_legend_items(widths, 3, 1, narrow),
            (std::vector<LegendItem>{{std::nullopt, 0, 0}}));
  EXPECT_TRUE(placed_legend_items(widths, 5, 1, narrow).empty());
}

TEST_F(Annotations, StandAboveAndBelowTheView) {
  const grains::State state = empty_state(60, 40, false);
  Style style;
  style.width = 640;
  style.height = 360;
  Painter painter(style, state.lattice, state.kinds);
  const grains::Occupancy occupancy(state);
  const Layout layout =
      layout_of(640, 360, box_with_frame(state.lattice), render::Annotations::all);
  const int below = layout.panel.y + layout.panel.height;
  const Image titled = painter.draw(state, occupancy, {}, {"Größe µ²", "step 1"});
  EXPECT_FALSE(blank(titled, 0, layout.panel.y));
  EXPECT_FALSE(blank(titled, below, 360));  // the scale bar
  EXPECT_TRUE(blank(painter.draw(state, occupancy, {}, {}), 0, layout.panel.y));
}

/// The widest run of white columns between the first and the last that are not, above `bottom`.
int widest_gap(const Image& image, int bottom) {
  int widest = 0;
  int last = image.width;
  for (int x = 0; x < image.width; ++x) {
    bool white = true;
    for (int y = 0; y < bottom; ++y) {
      white = white && image.at(x, y) == Rgb{255, 255, 255};
    }
    if (!white) {
      widest = std::max(widest, x - last - 1);
      last = x;
    }
  }
  return widest;
}

TEST_F(Annotations, LeaveAGapBetweenTitleAndDetail) {
  for (const int width : {300, 640, 1280}) {
    const Layout layout = layout_of(width, 360, {0, 0, 40, 30}, render::Annotations::all);
    for (std::size_t length = 1; length < 200; length += 3) {
      Graphics graphics(width, 360);
      annotate(graphics, layout, {std::string(length, 'H'), "HHHHHHHH"}, {});
      EXPECT_GE(widest_gap(graphics.image(), layout.panel.y), 1.4 * layout.text_size) << length;
    }
  }
}

TEST_F(Annotations, FitAnyNumberOfPatches) {
  Graphics graphics(400, 300);
  const Layout layout = layout_of(400, 300, {0, 0, 40, 20}, render::Annotations::all);
  Legend legend;
  for (std::size_t i = 0; i < 40; ++i) {
    legend.patches.push_back({"species " + std::to_string(i), palette_color(i)});
    annotate(graphics, layout, {"t", "d"}, legend);
  }
  legend.bars.push_back({"a label of some length", -1, 1e9});
  annotate(graphics, layout, {"t", "d"}, legend);
}

/// Pixels of a colour.
std::ptrdiff_t count(const Image& image, Rgb color) {
  return std::count(image.pixels.begin(), image.pixels.end(), color);
}

TEST_F(Annotations, ShowTheShapesOfSpecies) {
  const Layout layout = layout_of(3840, 2160, {0, 0, 40, 20}, render::Annotations::all);
  const auto area_of = [&](const std::vector<Eigen::Vector2d>& outline, double size) {
    Graphics graphics(3840, 2160);
    Legend legend;
    legend.patches = {{.label = "", .color = {200, 0, 0}, .outline = outline, .size = size}};
    annotate(graphics, layout, {}, legend);
    return static_cast<double>(count(graphics.image(), {200, 0, 0}));
  };
  const double square = area_of({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, 1);
  EXPECT_NEAR(area_of({{0, 0}, {3, 0}, {0, 3}}, 1), square / 2, 0.15 * square);
  EXPECT_NEAR(area_of({{0, 0}, {8, 0}, {8, 4}, {0, 4}}, 1), square / 2, 0.15 * square);
  EXPECT_NEAR(area_of({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, 0.6), 0.36 * square, 0.15 * square);
}

TEST_F(Annotations, MarkTheEndsOfABarBeyondWhichValuesLie) {
  const Layout layout = layout_of(1280, 720, {0, 0, 40, 20}, render::Annotations::all);
  const auto ends = [&](bool below, bool above) {
    Graphics graphics(1280, 720);
    Legend legend;
    legend.bars = {{.label = "load", .low = 1, .high = 2, .below = below, .above = above}};
    annotate(graphics, layout, {}, legend);
    const Image image = graphics.image();
    return std::pair(count(image, viridis_color(0)), count(image, viridis_color(1)));
  };
  const auto neither = ends(false, false);
  const auto both = ends(true, true);
  EXPECT_GT(both.first, neither.first + 20);
  EXPECT_GT(both.second, neither.second + 20);
  EXPECT_EQ(ends(true, false), std::pair(both.first, neither.second));
}

TEST(PictureSize, FollowsTheViewUnlessItIsGiven) {
  for (const render::Annotations annotations :
       {render::Annotations::none, render::Annotations::legend, render::Annotations::all}) {
    for (const double aspect : {0.5, 0.8, 1.0, 1.5, 2.5}) {
      const lattice::Rectangle view = {0, 0, 100 * aspect, 100};
      const PixelBox size = picture_size(0, 0, view, annotations);
      EXPECT_NEAR(size.width * size.height, 1280 * 720, 0.02 * 1280 * 720);
      EXPECT_EQ(size.width % 2 + size.height % 2, 0);
      const Layout layout = layout_of(size.width, size.height, view, annotations);
      const int margin = layout.text_size;
      EXPECT_LE(layout.panel.x, margin + 8) << aspect;
      EXPECT_LE(layout.panel.y, 2.4 * margin + 8) << aspect;
    }
  }
  EXPECT_EQ(picture_size(300, 200, {0, 0, 1, 9}, render::Annotations::all).height, 200);
  EXPECT_EQ(picture_size(300, 0, {0, 0, 2, 1}, render::Annotations::none).height, 150);
  EXPECT_EQ(picture_size(0, 300, {0, 0, 2, 1}, render::Annotations::none).width, 600);
  EXPECT_EQ(picture_size(0, 300, {0, 0, 1000, 1}, render::Annotations::none).width, 1200);
}

TEST(CommonLegend, HasWhatBothHaveAndWhatOneHas) {
  Legend first;
  first.bars = {{.label = "load", .low = 0, .high = 2, .above = true}};
  first.patches = {{.label = "wall"}};
  Legend second = first;
  second.bars[0].above = false;
  second.bars[0].below = true;
  second.patches.push_back({.label = "moving wall"});
  const auto both = common_legend(first, second);
  ASSERT_TRUE(both);
  EXPECT_TRUE(both->bars[0].above && both->bars[0].below);
  EXPECT_EQ(both->patches.size(), 2U);
  second.bars[0].high = 3;
  EXPECT_FALSE(common_legend(first, second));
}

TEST(CommonLegend, ThereIsNoneWhereLinesDiffer) {
  Legend first;
  first.lines = {{.label = "0.5 m/s"}};
  Legend second = first;
  EXPECT_EQ(common_legend(first, second), first);
  second.lines[0].label = "2 m/s";
  EXPECT_FALSE(common_legend(first, second));
}

TEST(LegendText, IsReadAsItWasWritten) {
  Legend legend;
  legend.patches = {{"small \"µ\"", {1, 2, 3}, {{0, 0.5}, {-0.866, 1}}, 0.6}};
  legend.bars = {{"load (grain weights)", -1.5, 0.1, true, false, true}};
  legend.lines = {{"0.5 spacings per step", 0.3, 12, {4, 5, 6}, true}};
  legend.fade = 0.6;
  EXPECT_EQ(parse_legend(to_text(legend)), legend);
  EXPECT_EQ(parse_legend("12 650 900 49"), Legend()) << "of an earlier version";
  EXPECT_EQ(parse_legend("[]"), Legend());
}

}  // namespace
}  // namespace clca::render::annotations_test
