#include "clca/render/painter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "clca/render/coloring.hpp"
#include "clca/render/difference.hpp"
#include "packed_state.hpp"

namespace clca::render::painter_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Rgb kWhite = {255, 255, 255};
constexpr auto kBothWays = {DrawingMethod::polygons, DrawingMethod::lookup};

std::size_t count_of(const Image& image, Rgb color) {
  return static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), color));
}

grains::State one_hexagon(int radius) {
  grains::State state = empty_state(40, 40, false);
  state.kinds = {{lattice::Shape::hexagon(radius), 0}};
  grains::Particle particle;
  particle.column = 20;
  particle.row = 20;
  state.particles = {particle};
  state.origins = {particle.site()};
  return state;
}

TEST(Painter, DrawsAHexagonWithTheAreaOfItsBody) {
  for (const DrawingMethod drawing : kBothWays) {
    const double left = lattice::kColumnPitch * 20 - 5;
    const Image image = picture(one_hexagon(2), drawing, 400, 400, 1, {left, 15, left + 10, 25});
    const double spacing = 40;
    // A hexagon of circumradius R has the area 3/2 sqrt(3) R^2.
    const double expected = 1.5 * std::sqrt(3.0) * 2.5 * 2.5 * spacing * spacing;
    const auto drawn = static_cast<double>(image.pixels.size() - count_of(image, kWhite));
    EXPECT_NEAR(drawn, expected, 0.01 * expected);  // a pixel in width along the perimeter
  }
}

TEST(Painter, MovesThePictureWithTheView) {
  const grains::State state = to_sample(60, 40, false).state();
  for (const DrawingMethod drawing : kBothWays) {
    const Image low = picture(state, drawing, 400, 300, 1, {5, 2, 25, 17});
    const Image high = picture(state, drawing, 400, 300, 1, {5, 5, 25, 20});  // 60 pixels up
    std::size_t differing = 0;
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 400; ++x) {
        differing += low.at(x, y) != high.at(x, y + 60) ? 1U : 0U;
      }
    }
    EXPECT_LE(differing, 400U * 240 / 500);
  }
}

TEST(Painter, DrawsAMirroredStateAsAMirroredPicture) {
  // Hexagons in a box with an odd number of columns, where mirrored columns stand equally high.
  grains::State state = to_sample(61, 40, false).state();
  std::erase_if(state.particles, [](const auto& particle) { return particle.kind > 1; });
  state.walls.clear();
  state.origins.resize(state.particles.size());
  grains::State mirrored = state;
  for (grains::Particle& particle : mirrored.particles) {
    particle.column = 60 - particle.column;
  }
  for (const DrawingMethod drawing : kBothWays) {
    Image image = picture(mirrored, drawing, 500, 400, 1);
    for (int y = 0; y < image.height; ++y) {
      const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width;
      std::reverse(row, row + image.width);
    }
    const Difference difference = difference_of(image, picture(state, drawing, 500, 400, 1), 2);
    EXPECT_LE(difference.differing_pixels, 500U * 400 / 400);
  }
}

TEST(Painter, LeavesTheLidOffAndDrawsFloorAndSideWalls) {
  for (const DrawingMethod drawing : kBothWays) {
    const Image image = picture(one_hexagon(1), drawing, 300, 340, 1);
    const Rgb floor = image.at(150, 336);
    EXPECT_NE(floor, kWhite);
    EXPECT_EQ(image.at(2, 180), floor);
    EXPECT_EQ(image.at(297, 180), floor);
    EXPECT_EQ(image.at(150, 4), kWhite);
  }
}

TEST(Painter, DrawsWallBlocksWithoutInnerSeams) {
  grains::State one = empty_state(40, 40, false);
  one.walls = {{lattice::sites_in(one.lattice, {5, 5, 20, 20}), true}};
  grains::State two = one;
  two.walls = {{lattice::sites_in(one.lattice, {5, 5, 12, 20}), true},
               {lattice::sites_in(one.lattice, {12, 5, 20, 20}), true}};
  for (const DrawingMethod drawing : kBothWays) {
    EXPECT_EQ(picture(one, drawing, 200, 200, 2), picture(two, drawing, 200, 200, 2));
  }
}

TEST(Painter, ForgetsAWallThatIsTakenAway) {
  automaton::Automaton automaton = to_sample(60, 40, false);
  Style style;
  style.width = 200;
  style.height = 150;
  style.annotations = Annotations::none;
  for (const DrawingMethod drawing : kBothWays) {
    style.drawing = drawing;
    grains::State state = automaton.state();
    Painter painter(style, state.lattice, state.kinds);
    const Coloring coloring = color_by_id(state);
    const Image before = painter.draw(state, grains::Occupancy(state), coloring, {});
    EXPECT_EQ(painter.draw(state, grains::Occupancy(state), coloring, {}), before);
    state.walls[0].present = false;
    const Image after = painter.draw(state, grains::Occupancy(state), coloring, {});
    EXPECT_NE(after, before);
    EXPECT_EQ(after, picture(state, drawing, 200, 150, 2));
  }
}

TEST(Painter, DevelopsWhatItHasExposedWhileTheStateGoesOn) {
  for (const DrawingMethod drawing : kBothWays) {
    automaton::Automaton automaton = to_sample(60, 40, true);
    Style style;
    style.drawing = drawing;
    Painter painter(style, automaton.state().lattice, automaton.state().kinds);
    const auto exposed = [&] {
      return painter.capture(automaton.state(), automaton.occupancy(),
                             color_by_displacement(automaton.state(), {0, 20}));
    };
    const Image before = painter.rasterize(exposed(), {});
    const Capture kept = exposed();
    for (int step = 0; step < 20; ++step) {
      automaton.step();
    }
    Image developed;
    std::thread beside([&] { developed = painter.rasterize(kept, {}); });
    const Capture later = exposed();
    beside.join();
    EXPECT_EQ(developed, before);
    EXPECT_NE(painter.rasterize(later, {}), before);
  }
}

TEST(Painter, DrawsTinyPictures) {
  const grains::State state = to_sample(60, 40, false).state();
  for (const auto& [width, height] :
       {std::pair{1, 1}, {64, 64}, {3, 200}, {200, 3}, {90, 110}, {160, 120}}) {
    Style style;
    style.width = width;
    style.height = height;
    Painter painter(style, state.lattice, state.kinds);
    const Image image =
        painter.draw(state, grains::Occupancy(state), color_by_displacement(state, {0, 5}),
                     {"A title that is much too long for this", "and a detail too"});
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
  }
}

TEST(Painter, RefusesAPictureThatIsTooLarge) {
  const grains::State state = one_hexagon(1);
  EXPECT_THAT(
      [&] {
        picture(state, DrawingMethod::polygons, 10000, 100, 2, {0, 0, 400, 4});
      },
      ThrowsMessage<RenderError>(
          AllOf(HasSubstr("10000 x 100"), HasSubstr("16384"), HasSubstr("2"))));
  EXPECT_EQ(picture(state, DrawingMethod::lookup, 10000, 100, 2, {0, 0, 400, 4}).width, 10000);
  EXPECT_THAT([&] { picture(state, DrawingMethod::lookup, 100, 2000000000, 4); },
              ThrowsMessage<RenderError>(HasSubstr("100 x 2000000000 pixels is too large")));
}

TEST(Painter, RefusesSizesAndViewsThatMakeNoSense) {
  const grains::State state = one_hexagon(1);
  EXPECT_THROW(picture(state, DrawingMethod::lookup, -1, 100, 1), RenderError);
  EXPECT_THROW(picture(state, DrawingMethod::lookup, 100, -1, 1), RenderError);
  EXPECT_THROW(picture(state, DrawingMethod::lookup, 100, 100, 0), RenderError);
  EXPECT_THROW(picture(state, DrawingMethod::lookup, 100, 100, 5), RenderError);
  EXPECT_THROW(picture(state, DrawingMethod::lookup, 100, 100, 1, {3, 0, 2, 1}), RenderError);
  EXPECT_THROW(picture(state, DrawingMethod::lookup, 100, 100, 1, {0, 0, INFINITY, 1}),
               RenderError);
}

TEST(Painter, DrawsAnyViewHoweverFarOrLarge) {
  const grains::State state = to_sample(60, 40, true).state();
  for (const DrawingMethod drawing : kBothWays) {
    const Image outside = picture(state, drawing, 50, 50, 2, {1e12, 1e12, 2e12, 2e12});
    EXPECT_EQ(count_of(outside, kWhite), outside.pixels.size());
    picture(state, drawing, 50, 50, 1, {-1e15, -1e15, 1e15, 1e15});
    picture(state, drawing, 50, 50, 1, {20, 10, 20 + 1e-9, 10 + 1e-9});
    picture(state, drawing, 50, 50, 1, {20, 0, 20.001, 40});
  }
}

TEST(Painter, RefusesAnotherLatticeAndColorsOfAnotherState) {
  const grains::State state = one_hexagon(1);
  Painter painter({}, state.lattice, state.kinds);
  const grains::Occupancy occupancy(state);
  EXPECT_THROW(painter.draw(state, occupancy, {}, {}), std::invalid_argument);
  EXPECT_THROW(painter.draw(state, occupancy, {.palette_indices = {0}}, {}), std::invalid_argument);
  EXPECT_THROW(painter.draw(state, occupancy, {.palette_indices = {1}, .palette = {{1, 2, 3}}}, {}),
               std::invalid_argument);
  const grains::State other = to_sample(60, 40, false).state();
  EXPECT_THROW(painter.draw(other, grains::Occupancy(other), color_by_id(other), {}),
               std::invalid_argument);
}

TEST(Painter, DrawsAnEmptyBox) {
  for (const DrawingMethod drawing : kBothWays) {
    const Image image = picture(empty_state(30, 20, false), drawing, 120, 80, 2);
    EXPECT_GT(count_of(image, kWhite), image.pixels.size() / 2);
  }
}

TEST(Painter, WorksBesideAnotherOneAndAfterAMove) {
  const grains::State first = to_sample(60, 40, false).state();
  const grains::State second = to_sample(50, 50, true).state();
  Style style;
  style.width = 320;
  style.height = 200;
  Painter one(style, first.lattice, first.kinds);
  Painter two(style, second.lattice, second.kinds);
  const auto draw = [](Painter& painter, const grains::State& state) {
    return painter.draw(state, grains::Occupancy(state), color_by_id(state), {"a", "b"});
  };
  const Image one_alone = draw(one, first);
  const Image two_alone = draw(two, second);
  Painter moved = std::move(one);
  EXPECT_EQ(draw(moved, first), one_alone);
  EXPECT_EQ(draw(two, second), two_alone);
  Image one_beside;
  std::thread thread([&] { one_beside = draw(moved, first); });
  const Image two_beside = draw(two, second);
  thread.join();
  EXPECT_EQ(one_beside, one_alone);
  EXPECT_EQ(two_beside, two_alone);
}

}  // namespace
}  // namespace clca::render::painter_test
