#include "clca/render/overlays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clca/render/coloring.hpp"
#include "packed_state.hpp"
#include "render/annotations.hpp"
#include "support/missing.hpp"

namespace clca::render::overlays_test {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const UnitName kUnit = {"spacing per cycle", "spacings per cycle"};

int darkness(Rgb color) {
  return 3 * 255 - color.red - color.green - color.blue;
}

TEST(ForceNetwork, DrawsStrongContactsWideAndOnTop) {
  const std::vector<ForceLine> lines = {
      {{0, 0}, {1, 0}, 6}, {{0, 1}, {1, 1}, 1}, {{0, 2}, {1, 2}, 60}, {{0, 3}, {1, 3}, 3}};
  const Overlay overlay = force_network(lines, 6, "overlap");
  ASSERT_EQ(overlay.strokes.size(), 4U);
  EXPECT_GT(overlay.fade, 0);
  EXPECT_EQ(overlay.strokes[0].from.y(), 1);
  EXPECT_EQ(overlay.strokes[1].from.y(), 3);
  EXPECT_EQ(overlay.strokes[2].from.y(), 0);
  EXPECT_EQ(overlay.strokes[3].from.y(), 2);
  EXPECT_LT(overlay.strokes[0].width, overlay.strokes[1].width);
  EXPECT_DOUBLE_EQ(overlay.strokes[2].width, 1.2);
  EXPECT_DOUBLE_EQ(overlay.strokes[3].width, 1.2);  // no wider than the strongest
  EXPECT_EQ(overlay.legend_lines.front().label, "overlap");
  EXPECT_DOUBLE_EQ(overlay.legend_lines.front().width, 1.2);
  EXPECT_EQ(overlay.legend_lines.front().color, overlay.strokes[0].color);
}

TEST(ForceNetwork, LeavesOutContactsWithoutStrength) {
  const std::vector<ForceLine> lines = {
      {{0, 0}, {1, 0}, 0}, {{0, 1}, {1, 1}, -1}, {{0, 2}, {1, 2}, kNan}, {{0, 3}, {1, 3}, 0.001}};
  EXPECT_EQ(force_network(lines, 6, "overlap").strokes.size(), 1U);
  EXPECT_TRUE(force_network(lines, 0, "").strokes.empty());
  EXPECT_TRUE(force_network(lines, kNan, "").strokes.empty());
  EXPECT_TRUE(force_network({}, 6, "").strokes.empty());
}

TEST(ArrowField, CentresArrowsOnTheirCells) {
  const std::vector<FieldArrow> arrows = {{{10, 20}, {0.3, 0.4}}, {{30, 20}, {-0.1, 0}}};
  const Overlay overlay = arrow_field(arrows, 5, 0.5, kUnit);
  ASSERT_EQ(overlay.strokes.size(), 2U);
  const Stroke& weak = overlay.strokes[0];
  const Stroke& strong = overlay.strokes[1];
  EXPECT_TRUE(strong.is_arrow);
  EXPECT_NEAR((strong.to - strong.from).norm(), 0.9 * 5, 1e-12);
  EXPECT_NEAR(((strong.to + strong.from) / 2 - Eigen::Vector2d(10, 20)).norm(), 0, 1e-12);
  EXPECT_NEAR((strong.to - strong.from).x(), 0.9 * 5 * 0.6, 1e-12);
  EXPECT_NEAR((weak.to - weak.from).norm(), 0.9, 1e-12);
  EXPECT_LT(weak.to.x(), weak.from.x());
  EXPECT_GT(darkness(strong.color), darkness(weak.color));
}

TEST(ArrowField, TakesNoMotionAndNoNumbers) {
  const std::vector<FieldArrow> arrows = {{{10, 20}, {0, 0}}, {{10, 20}, {kNan, 0}}};
  EXPECT_EQ(arrow_field(arrows, 5, 0.5, kUnit).strokes.size(), 1U);  // a dot
  EXPECT_TRUE(arrow_field(arrows, 5, 0, kUnit).strokes.empty());
  EXPECT_TRUE(arrow_field(arrows, kNan, 1, kUnit).strokes.empty());
}

TEST(ArrowField, LegendLineIsARoundLengthToTheSameScale) {
  const Legend::Line line = arrow_field({}, 5, 0.61, kUnit).legend_lines.front();
  EXPECT_EQ(line.label, "0.5 spacings per cycle");
  EXPECT_NEAR(line.length, 0.9 * 5 * 0.5 / 0.61, 1e-12);
  EXPECT_TRUE(line.arrow);
  EXPECT_EQ(arrow_field({}, 5, 0, kUnit).legend_lines.front().label, "0 spacings per cycle");
  EXPECT_EQ(arrow_field({}, 5, 1.5, kUnit).legend_lines.front().label, "1 spacing per cycle");
}

TEST(ArrowField, CutsNoArrow) {
  const std::vector<FieldArrow> arrows = {{{10, 20}, {0.6, 0}}, {{30, 20}, {0, 1.2}}};
  const Overlay overlay = arrow_field(arrows, 5, 0.6, kUnit);
  EXPECT_NEAR((overlay.strokes[0].to - overlay.strokes[0].from).norm(), 0.9 * 5, 1e-12);
  EXPECT_NEAR((overlay.strokes[1].to - overlay.strokes[1].from).norm(), 0.9 * 10, 1e-12);
}

TEST(ArrowField, TypicalLengthIsThatOfTheArrowsThatMove) {
  std::vector<FieldArrow> arrows(10, {{0, 0}, {0.3, 0.4}});
  EXPECT_DOUBLE_EQ(typical_length(arrows), 0.5);
  arrows.resize(100, {{0, 0}, {0, 0}});
  arrows.push_back({{0, 0}, {kNan, 0}});
  EXPECT_DOUBLE_EQ(typical_length(arrows), 0.5);
  EXPECT_EQ(typical_length(std::span(arrows).subspan(10)), 0);
  EXPECT_EQ(typical_length({}), 0);
}

class LegendLine : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string problem = font_warning(); !problem.empty()) {
      CLCA_SKIP_AS_MISSING(problem);
    }
  }
};

struct Box {
  int left = 10000, right = -1, top = 10000, bottom = -1;
};

/// Around the pixels of this colour below the panel.
Box around(const Image& image, const Layout& layout, Rgb color) {
  Box box;
  for (int y = layout.panel.y + layout.panel.height; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) == color) {
        box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y),
               std::max(box.bottom, y)};
      }
    }
  }
  return box;
}

Image with_legend(const Layout& layout, const Legend& legend) {
  Graphics graphics(1280, 720);
  annotate(graphics, layout, {}, legend);
  return graphics.image();
}

TEST_F(LegendLine, IsAsThickAndLongAsInThePicture) {
  const Layout layout = layout_of(1280, 720, {0, 0, 120, 60}, Annotations::all);
  Legend legend;
  legend.lines = {{"0.5 spacings per cycle", 0.8, 6, {0, 0, 200}, false}};
  const Box box = around(with_legend(layout, legend), layout, {0, 0, 200});
  EXPECT_NEAR(box.right - box.left + 1, 6 * layout.pixels_per_spacing, 2);
  EXPECT_NEAR(box.bottom - box.top + 1, 0.8 * layout.pixels_per_spacing, 2);
}

TEST_F(LegendLine, IsNoThickerThanText) {
  const Layout layout = layout_of(1280, 720, {0, 0, 12, 6}, Annotations::all);
  Legend legend;
  legend.lines = {{"overlap 6 sites", 1.2, 0, {139, 0, 18}, false}};
  const Box box = around(with_legend(layout, legend), layout, {139, 0, 18});
  EXPECT_LE(box.bottom - box.top, layout.text_size);
  EXPECT_GT(box.right - box.left, layout.text_size);
}

TEST_F(LegendLine, HasItsLabel) {
  const Layout layout = layout_of(1280, 720, {0, 0, 120, 60}, Annotations::all);
  Legend named;
  named.lines = {{"overlap 6 sites", 1.2, 0, {139, 0, 18}, false}};
  Legend nameless = named;
  nameless.lines[0].label.clear();
  EXPECT_NE(with_legend(layout, named), with_legend(layout, nameless));
}

TEST_F(LegendLine, StandsBesideABarInsideThePicture) {
  for (const double width : {30.0, 60.0, 120.0}) {
    const Layout layout = layout_of(1280, 720, {0, 0, width, 60}, Annotations::all);
    Legend legend;
    legend.bars = {{"overlapped sites", 0, 12}};
    legend.patches = {{"none", {1, 200, 3}}};
    legend.lines = force_network({}, 6, "overlap 6 sites").legend_lines;
    const Image image = with_legend(layout, legend);
    const Box patch = around(image, layout, {1, 200, 3});
    const Box line = around(image, layout, legend.lines[0].color);
    EXPECT_GT(patch.left, layout.text_left + 11 * layout.text_size);
    EXPECT_GT(line.left, layout.text_left + 11 * layout.text_size);
    EXPECT_GT(line.right, line.left);
    EXPECT_LT(line.right, layout.text_right);
  }
}

TEST_F(LegendLine, FadesPatchesAsThePictureDoes) {
  const Layout layout = layout_of(1280, 720, {0, 0, 120, 60}, Annotations::all);
  Legend legend;
  legend.patches = {{"grains", {55, 55, 55}}};
  legend.fade = 0.5;
  const Image image = with_legend(layout, legend);
  EXPECT_EQ(around(image, layout, {55, 55, 55}).right, -1);
  EXPECT_GT(around(image, layout, {155, 155, 155}).right, 0);
}

}  // namespace
}  // namespace clca::render::overlays_test
