#include "render/annotations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "clca/render/coloring.hpp"
#include "packed_state.hpp"
#include "render/legend_lines.hpp"
#include "support/missing.hpp"

namespace clca::render {
namespace {

class Annotations : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string problem = font_problem(); !problem.empty()) {
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
  EXPECT_DOUBLE_EQ(round_length(1), 1);
  EXPECT_DOUBLE_EQ(round_length(1.99), 1);
  EXPECT_DOUBLE_EQ(round_length(4.9), 2);
  EXPECT_DOUBLE_EQ(round_length(73), 50);
  EXPECT_DOUBLE_EQ(round_length(0.3), 0.2);
}

TEST(MetresText, TakesTheUnitThatMakesTheNumberOneOrMore) {
  EXPECT_EQ(metres_text(round_length(30)), "20 m");
  EXPECT_EQ(metres_text(round_length(0.7)), "500 mm");
  EXPECT_EQ(metres_text(round_length(0.0012)), "1 mm");
  EXPECT_EQ(metres_text(round_length(0.00025)), "200 µm");
}

TEST(Ticks, AreFewAndRound) {
  EXPECT_EQ(ticks(0, 40, 6), (std::vector<double>{0, 10, 20, 30, 40}));
  EXPECT_EQ(ticks(3, 3, 6), (std::vector<double>{3}));
  for (const double high : {0.07, 1.0, 3.3, 9.0, 11.0, 99.0, 12345.0}) {
    const std::vector<double> values = ticks(0, high, 6);
    EXPECT_GE(values.size(), 2U) << high;
    EXPECT_LE(values.size(), 6U) << high;
    EXPECT_LE(values.back(), high * (1 + 1e-6));
  }
}

TEST(Layout, GivesTheWholePictureToTheViewWithoutAnnotations) {
  const Layout layout = arrange(400, 300, {0, 0, 40, 30}, false);
  EXPECT_EQ(layout.panel.width, 400);
  EXPECT_EQ(layout.panel.height, 300);
  EXPECT_DOUBLE_EQ(layout.scale, 10);
  EXPECT_EQ(layout.text_size, 0);
}

TEST(Layout, KeepsTheViewInsideThePicture) {
  for (const int width : {1, 50, 300, 1280}) {
    for (const int height : {1, 40, 200, 720}) {
      for (const double aspect : {0.001, 0.3, 1.0, 7.0, 5000.0}) {
        const PixelBox panel = arrange(width, height, {0, 0, aspect, 1}, true).panel;
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
  const int wide = arrange(1280, 720, view, true).text_size;
  EXPECT_EQ(arrange(3840, 2160, view, true).text_size, 3 * wide);
  EXPECT_EQ(arrange(2000, 720, view, true).text_size, wide);
  EXPECT_EQ(arrange(900, 720, view, true).text_size, wide);
  EXPECT_LT(arrange(720, 720, view, true).text_size, wide);
  const Layout upright = arrange(720, 1280, view, true);
  EXPECT_LT(upright.text_size, wide);
  EXPECT_GE(upright.text_right - upright.text_left, 44 * upright.text_size);
  // A tall view is narrower than its caption.
  const Layout tall = arrange(1280, 720, {0, 0, 10, 40}, true);
  EXPECT_LT(tall.text_left, tall.panel.x);
  EXPECT_EQ(tall.text_right - tall.text_left, 44 * tall.text_size);
}

TEST(LegendLines, TakeASecondLineBeforeTheyGiveUp) {
  const std::vector<double> widths(4, 10.0);
  const std::vector<double> rooms = {25, 40};
  const auto lines = [&](std::size_t count) {
    return legend_lines(std::span(widths).first(count), 3, 1, rooms);
  };
  EXPECT_TRUE(lines(0).empty());
  EXPECT_EQ(lines(2), (std::vector<LegendItem>{{0, 0, 0}, {1, 11, 0}}));
  EXPECT_EQ(lines(4), (std::vector<LegendItem>{{0, 0, 0}, {1, 11, 0}, {2, 0, 1}, {3, 11, 1}}));
}

TEST(LegendLines, LeaveOutThoseBeforeTheLast) {
  const std::vector<double> widths(9, 10.0);
  const std::vector<double> rooms = {25, 25};
  EXPECT_EQ(legend_lines(widths, 3, 1, rooms),
            (std::vector<LegendItem>{
                {0, 0, 0}, {1, 11, 0}, {2, 0, 1}, {std::nullopt, 11, 1}, {8, 15, 1}}));
  const std::vector<double> narrow = {4, 4};
  EXPECT_EQ(legend_lines(widths, 3, 1, narrow), (std::vector<LegendItem>{{std::nullopt, 0, 0}}));
  EXPECT_TRUE(legend_lines(widths, 5, 1, narrow).empty());
}

TEST_F(Annotations, StandAboveAndBelowTheView) {
  const grains::State state = empty_state(60, 40, false);
  Style style;
  style.width = 640;
  style.height = 360;
  Painter painter(style, state.lattice, state.kinds);
  const grains::Occupancy occupancy(state);
  const Layout layout = arrange(640, 360, whole_box(state.lattice), true);
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
  Annotator annotator;
  for (const int width : {300, 640, 1280}) {
    const Layout layout = arrange(width, 360, {0, 0, 40, 30}, true);
    for (std::size_t length = 1; length < 200; length += 3) {
      Image image(width, 360, {255, 255, 255});
      annotator.draw(image, layout, {std::string(length, 'H'), "HHHHHHHH"}, {});
      EXPECT_GE(widest_gap(image, layout.panel.y), 1.4 * layout.text_size) << length;
    }
  }
}

TEST_F(Annotations, ShortenTextWithAnEllipsis) {
  Font font;
  font.set_size(20);
  const std::string text = "Granular flow of many grains";
  EXPECT_EQ(font.shortened(text, 1000), text);
  const std::string shorter = font.shortened(text, 120);
  EXPECT_LE(font.width(shorter), 120);
  EXPECT_TRUE(shorter.ends_with("…"));
  EXPECT_GT(shorter.size(), 8U);
  EXPECT_EQ(font.shortened(text, 1), "");
  EXPECT_EQ(font.shortened("", 0), "");
}

TEST_F(Annotations, GrowWithTheTextSize) {
  Font font;
  font.set_size(10);
  const double small = font.width("flow");
  font.set_size(40);
  EXPECT_NEAR(font.width("flow"), 4 * small, 1);
}

TEST_F(Annotations, FitAnyNumberOfPatches) {
  Image image(400, 300, {255, 255, 255});
  const Layout layout = arrange(400, 300, {0, 0, 40, 20}, true);
  Legend legend;
  Annotator annotator;
  for (std::size_t i = 0; i < 40; ++i) {
    legend.patches.push_back({"species " + std::to_string(i), palette_color(i)});
    annotator.draw(image, layout, {"t", "d"}, legend);
  }
  legend.bars.push_back({"a label of some length", -1, 1e9});
  annotator.draw(image, layout, {"t", "d"}, legend);
}

}  // namespace
}  // namespace clca::render
