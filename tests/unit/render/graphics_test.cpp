#include "render/graphics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clca/render/coloring.hpp"
#include "clca/render/difference.hpp"
#include "clca/render/painter.hpp"
#include "packed_state.hpp"
#include "render/layout.hpp"
#include "support/missing.hpp"

namespace clca::render::graphics_test {
namespace {

constexpr Rgb kWhite = {255, 255, 255};
constexpr Rgb kRed = {200, 0, 0};

/// A stroke on white paper, in pixels.
Image drawn(const Stroke& stroke, int width = 60, int height = 40) {
  Graphics graphics(width, height);
  graphics.draw_stroke(stroke);
  return graphics.image();
}

/// The area that a stroke covers, in pixels.
double area(const Image& image) {
  double sum = 0;
  for (const Rgb pixel : image.pixels) {
    sum += (255.0 - pixel.green) / 255;
  }
  return sum;
}

Image half_turned(const Image& image) {
  Image result = image;
  std::reverse(result.pixels.begin(), result.pixels.end());
  return result;
}

TEST(Stroke, LiesWhereItsEndsSay) {
  const Image image = drawn({{10, 20}, {50, 20}, 4, kRed, false});
  for (const int x : {10, 30, 49}) {
    EXPECT_EQ(image.at(x, 18), kRed);
    EXPECT_EQ(image.at(x, 21), kRed);
    EXPECT_EQ(image.at(x, 17), kWhite);
    EXPECT_EQ(image.at(x, 22), kWhite);
  }
  EXPECT_EQ(image.at(7, 20), kWhite);
  EXPECT_EQ(image.at(52, 20), kWhite);
}

TEST(Stroke, HasRoundEndsAndItsArea) {
  for (const double angle : {0.0, 0.3, 0.7853981633974483, 1.2, 1.5707963267948966}) {
    for (const double width : {1.0, 3.0, 7.5}) {
      const Eigen::Vector2d half(12 * std::cos(angle), 12 * std::sin(angle));
      const Eigen::Vector2d middle(30.2, 19.7);
      const double ends = 3.14159265 / 4 * width * width;
      const double expected = 24 * width + ends;
      EXPECT_NEAR(area(drawn({middle - half, middle + half, width, kRed, false})), expected,
                  0.08 * expected)
          << angle << " " << width;
    }
  }
}

TEST(Stroke, LooksTheSameFromBothEnds) {
  const Image image = drawn({{12.5, 7.25}, {47.5, 32.75}, 3.3, kRed, false});
  EXPECT_LE(difference_of(image, half_turned(image), 0).largest_difference, 20);
  EXPECT_LE(difference_of(image, drawn({{47.5, 32.75}, {12.5, 7.25}, 3.3, kRed, false}), 0)
                .largest_difference,
            4);
}

TEST(Stroke, ThatIsThinIsPale) {
  const Image image = drawn({{10, 20.5}, {50, 20.5}, 0.25, kRed, false});
  EXPECT_NEAR(image.at(30, 20).green, 255 * 0.75, 16);
  EXPECT_EQ(image.at(30, 19), kWhite);
  EXPECT_EQ(image.at(30, 21), kWhite);
}

TEST(Stroke, OfAnArrowHasAHeadAtItsEnd) {
  const Image image = drawn({{5, 20}, {55, 20}, 3, kRed, true});
  const auto thickness = [&](int x) {
    int count = 0;
    for (int y = 0; y < image.height; ++y) {
      count += image.at(x, y) != kWhite ? 1 : 0;
    }
    return count;
  };
  EXPECT_LE(thickness(20), 4);
  EXPECT_GE(thickness(44), 9);
  EXPECT_LT(thickness(52), thickness(46));
  EXPECT_EQ(image.at(57, 20), kWhite);
  for (int y = 0; y < 20; ++y) {
    EXPECT_EQ(image.at(44, y), image.at(44, 39 - y));
  }
}

TEST(Stroke, OfAShortArrowIsADot) {
  for (const double length : {0.0, 0.2, 4.5}) {
    const Image image = drawn({{30 - length / 2, 20}, {30 + length / 2, 20}, 5, kRed, true});
    EXPECT_LE(difference_of(image, half_turned(image), 0).largest_difference, 20) << length;
    EXPECT_EQ(image.at(30, 20), kRed);
    EXPECT_NEAR(area(image), 10, 1) << length;
  }
}

TEST(Stroke, IsCutOffAtTheRim) {
  const Image whole = drawn({{-100, -60}, {160, 100}, 5, kRed, false}, 60, 40);
  EXPECT_EQ(whole.at(30, 20), kRed);
  EXPECT_EQ(whole, drawn({{-1000, -613.8461538461538}, {1060, 653.8461538461538}, 5, kRed, false}));
}

TEST(Stroke, OutsideOrWithoutSenseIsNotDrawn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const double huge = std::numeric_limits<double>::max();
  const Image blank(60, 40, kWhite);
  for (const bool arrow : {false, true}) {
    for (const double wrong : {nan, infinite, -infinite, huge, -huge}) {
      EXPECT_EQ(drawn({{wrong, 20}, {30, 20}, 3, kRed, arrow}), blank);
      EXPECT_EQ(drawn({{30, wrong}, {30, 20}, 3, kRed, arrow}), blank);
      EXPECT_EQ(drawn({{30, 20}, {wrong, wrong}, 3, kRed, arrow}), blank);
      EXPECT_EQ(drawn({{30, 20}, {40, 20}, wrong, kRed, arrow}), blank);
    }
    EXPECT_EQ(drawn({{30, 20}, {40, 20}, 0, kRed, arrow}), blank);
    EXPECT_EQ(drawn({{30, 20}, {40, 20}, -2, kRed, arrow}), blank);
    for (const double far : {100.0, 1e5, 1e11}) {
      EXPECT_EQ(drawn({{far, 20}, {far + 9, 20}, 3, kRed, arrow}), blank);
      EXPECT_EQ(drawn({{-far - 9, 20}, {-far, 20}, 3, kRed, arrow}), blank);
      EXPECT_EQ(drawn({{30, far}, {39, far}, 3, kRed, arrow}), blank);
      EXPECT_EQ(drawn({{30, -far}, {39, -far}, 3, kRed, arrow}), blank);
      EXPECT_EQ(drawn({{2 * far, 20}, {30, -2 * far}, 3, kRed, arrow}), blank);
    }
  }
}

TEST(Stroke, FromFarAwayCrossesThePicture) {
  const Image image = drawn({{-9e5, 20}, {9e5, 20}, 4, kRed, false});
  EXPECT_EQ(image.at(0, 20), kRed);
  EXPECT_EQ(image.at(59, 19), kRed);
  EXPECT_EQ(image.at(30, 10), kWhite);
}

TEST(Graphics, ResizesPicturesByMeans) {
  Image image(4, 2, {0, 0, 0});
  image.at(0, 0) = {100, 0, 8};
  image.at(1, 1) = {100, 0, 0};
  const Image half = resized(image, 2, 1);
  EXPECT_NEAR(half.at(0, 0).red, 50, 1);
  EXPECT_EQ(half.at(1, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(resized(image, 4, 2), image);
  const Image large = resized(Image(7, 5, kRed), 13, 11);
  EXPECT_EQ(large, Image(13, 11, kRed));
}

TEST(Graphics, TurnsAPanelAboutItsMiddle) {
  Image image(30, 30, kWhite);
  for (int y = 10; y < 20; ++y) {
    image.at(25, y) = kRed;  // on the right
  }
  Graphics graphics(50, 40);
  graphics.draw_clipped(10, 5, 30, 30, [&] {
    graphics.move_into({.x = 10, .y = 5, .width = 30, .height = 30}, 90);
    graphics.draw_image(image, 0, 0, 30, 30);
  });
  const Image picture = graphics.image();
  EXPECT_EQ(picture.at(25, 9), kRed);  // on top
  EXPECT_EQ(picture.at(25, 8), kWhite);
  EXPECT_EQ(std::count(picture.pixels.begin(), picture.pixels.end(), kRed), 10);
}

TEST(Graphics, RefusesPicturesThatCairoCannotDraw) {
  EXPECT_THROW(Graphics(40'000, 10), RenderError);
}

TEST(Graphics, DrawsTextThatFits) {
  if (const std::string problem = font_warning(); !problem.empty()) {
    CLCA_SKIP_AS_MISSING(problem);
  }
  Graphics graphics(400, 50);
  const std::string text = "Granular flow of many grains";
  const double whole = graphics.text(text, 20).width();
  EXPECT_NEAR(graphics.text(text, 40).width(), 2 * whole, 2);
  EXPECT_EQ(graphics.text(text, 20, 1000).width(), whole);
  const double shorter = graphics.text(text, 20, 120).width();
  EXPECT_LE(shorter, 120);
  EXPECT_GT(shorter, 80);
  EXPECT_EQ(graphics.text(text, 20, 1).width(), 0);
  EXPECT_EQ(graphics.text("", 20).width(), 0);
  EXPECT_GT(graphics.text("\x1b[31m\xff\n", 20).width(), 0);  // neither UTF-8 nor printable
  graphics.draw_text(graphics.text(text, 20), 5, 40, kRed);
  EXPECT_GT(area(graphics.image()), 300);
}

grains::State one_grain() {
  grains::State state = empty_state(40, 40, false);
  state.kinds = {{lattice::Shape::hexagon(3), 0}};
  grains::Particle particle;
  particle.column = 20;
  particle.row = 20;
  state.particles = {particle};
  state.origins = {particle.site()};
  return state;
}

Image overlaid(const grains::State& state, const Overlay& overlay,
               Annotations annotations = Annotations::none) {
  Style style;
  style.width = 400;
  style.height = 300;
  style.view = {0, 5, 40, 35};  // without annotations, ten pixels a spacing
  style.annotations = annotations;
  Painter painter(style, state.lattice, state.kinds);
  return painter.draw(state, grains::Occupancy(state), color_by_id(state), {}, overlay);
}

TEST(Overlay, ThatIsEmptyChangesNothing) {
  const grains::State state = one_grain();
  EXPECT_EQ(overlaid(state, {}),
            picture(state, DrawingMethod::lookup, 400, 300, 2, {0, 5, 40, 35}));
}

TEST(Overlay, StandsWhereTheParticlesStand) {
  const grains::State state = one_grain();
  const Eigen::Vector2d middle = centre(state, state.particles[0]);
  const Image image = overlaid(state, {{{middle, {30, 20}, 1, kRed, false}}, 0});
  const int x = static_cast<int>(middle.x() * 10);
  EXPECT_EQ(image.at(x, 150), kRed);
  EXPECT_EQ(image.at(299, 150), kRed);
  EXPECT_EQ(image.at(x, 157), overlaid(state, {}).at(x, 157));
}

TEST(Overlay, FadesWhatLiesBeneath) {
  const grains::State state = one_grain();
  const Image plain = overlaid(state, {});
  const Image half = overlaid(state, {{{{5, 20}, {9, 20}, 1, kRed, false}}, 0.5});
  EXPECT_NEAR(half.at(173, 150).red, (plain.at(173, 150).red + 255) / 2, 1);
  EXPECT_NEAR(half.at(173, 150).blue, (plain.at(173, 150).blue + 255) / 2, 1);
  EXPECT_EQ(half.at(70, 150), kRed);
  const Image gone = overlaid(state, {{}, 7.0});
  EXPECT_EQ(std::count(gone.pixels.begin(), gone.pixels.end(), kWhite), 400 * 300);
  EXPECT_EQ(overlaid(state, {{}, std::numeric_limits<double>::quiet_NaN()}), plain);
}

TEST(Overlay, StaysInsideThePanel) {
  const grains::State state = one_grain();
  const Image image =
      overlaid(state, {{{{-1000, 20}, {1000, 20}, 300, kRed, false}}, 0}, Annotations::all);
  const Layout layout = layout_of(400, 300, {0, 5, 40, 35},
                                  font_warning().empty() ? Annotations::all : Annotations::none);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool inside = x >= layout.panel.x && x < layout.panel.x + layout.panel.width &&
                          y >= layout.panel.y && y < layout.panel.y + layout.panel.height;
      EXPECT_EQ(image.at(x, y) == kRed, inside) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace clca::render::graphics_test
