// Walls that move, and particles that overlap because of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "clca/render/coloring.hpp"
#include "clca/render/difference.hpp"
#include "packed_state.hpp"
#include "render/colors.hpp"

namespace clca::render::moving_wall_test {
namespace {

constexpr auto kBothWays = {DrawingMethod::polygons, DrawingMethod::lookup};

std::size_t count_of(const Image& image, Rgb color) {
  return static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), color));
}

grains::Wall moving_wall(const grains::State& state, const lattice::Rectangle& place) {
  grains::Wall wall;
  wall.sites = lattice::sites_in(state.lattice, place);
  wall.motion = grains::WallMotion{lattice::Direction::up, grains::Drive{1, 1000}};
  return wall;
}

grains::State with_moving_wall(bool periodic) {
  grains::State state = empty_state(40, 40, periodic);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  state.walls = {{lattice::sites_in(state.lattice, {10, 3, 20, 6}), true},
                 moving_wall(state, {-1, 12, 12, 15})};
  return state;
}

/// The state without motions.
grains::State at_rest(grains::State state) {
  for (grains::Wall& wall : state.walls) {
    wall.sites = grains::current_sites(state.lattice, wall);
    wall.motion.reset();
  }
  return state;
}

constexpr lattice::Rectangle kView = {-2, -2, 38, 42};

/// Ten pixels a spacing.
Image seen(const grains::State& state, DrawingMethod drawing) {
  return picture(state, drawing, 400, 440, 1, kView);
}

Rgb at(const Image& image, double x, double y) {
  return image.at(static_cast<int>((x - kView.left) * 10),
                  image.height - 1 - static_cast<int>((y - kView.bottom) * 10));
}

TEST(MovingWall, HasAColorOfItsOwnWhereItStandsNow) {
  for (const bool periodic : {false, true}) {
    grains::State state = with_moving_wall(periodic);
    for (const int offset : {0, 7}) {
      state.walls[1].travel.offset = offset;
      for (const DrawingMethod drawing : kBothWays) {
        const Image image = seen(state, drawing);
        EXPECT_EQ(at(image, 5, 13.5 + offset), kMovingWallColor);
        EXPECT_EQ(at(image, 5, 13.5 + 7 - offset), kPaper);
        EXPECT_EQ(at(image, 15, 4.5), kWallColor);
        EXPECT_EQ(at(image, 15, -0.9), kWallColor);
        EXPECT_GT(count_of(image, kMovingWallColor), 3000U);
      }
    }
  }
}

TEST(MovingWall, HasTheFormOfAWallThatStands) {
  for (const bool periodic : {false, true}) {
    grains::State state = with_moving_wall(periodic);
    state.walls[1].travel.offset = 5;
    for (const DrawingMethod drawing : kBothWays) {
      Image image = seen(state, drawing);
      std::replace(image.pixels.begin(), image.pixels.end(), kMovingWallColor, kWallColor);
      EXPECT_LE(difference_of(image, seen(at_rest(state), drawing), 0).differing_pixels, 50U);
    }
  }
}

TEST(MovingWall, IsDrawnInsideTheBoxOnly) {
  grains::State state = with_moving_wall(false);
  for (const int offset : {-14, 26, 500}) {
    state.walls[1].travel.offset = offset;
    for (const DrawingMethod drawing : kBothWays) {
      const Image image = picture(state, drawing, 300, 300, 1);
      const std::size_t green = count_of(image, kMovingWallColor);
      EXPECT_EQ(green > 0, offset != 500);
    }
  }
}

TEST(MovingWall, CrossesThePeriodicSeamInOneColor) {
  grains::State state = with_moving_wall(true);
  state.walls = {moving_wall(state, {-0.1, 12, 0.1, 18})};  // column 0
  for (const lattice::Site site : lattice::sites_in(state.lattice, {33, 12, 34, 18})) {
    state.walls[0].sites.push_back(site);  // column 39
  }
  const double left = -lattice::kColumnPitch / 2;
  const double right = left + 40 * lattice::kColumnPitch;
  for (const DrawingMethod drawing : kBothWays) {
    const Image image = seen(state, drawing);
    for (const double x : {left + 0.1, right - 0.1}) {
      EXPECT_EQ(at(image, x, 14.5), kMovingWallColor);
      for (double y = 2; y < 39; y += 0.1) {
        EXPECT_NE(at(image, x, y), kWallColor);
      }
    }
  }
}

TEST(MovingWall, IsNotThereWhenItIsTakenAway) {
  grains::State state = with_moving_wall(false);
  state.walls[1].present = false;
  for (const DrawingMethod drawing : kBothWays) {
    EXPECT_EQ(count_of(picture(state, drawing, 300, 300, 1), kMovingWallColor), 0U);
  }
}

TEST(MovingWall, IsFollowedByTheBackdrop) {
  Style style;
  style.width = 300;
  style.height = 300;
  style.drawing = DrawingMethod::polygons;
  style.annotations = Annotations::none;
  grains::State state = with_moving_wall(false);
  Painter painter(style, state.lattice, state.kinds);
  for (int step = 0; step < 6; ++step) {
    ++state.walls[1].travel.clock;
    state.walls[1].travel.offset = step / 2;
    EXPECT_EQ(painter.draw(state, grains::Occupancy(state), {}, {}),
              picture(state, DrawingMethod::polygons, 300, 300, 2));
  }
}

TEST(MovingWall, HasAColorUnlikeAnyOther) {
  const auto distance = [](Rgb a, Rgb b) {
    return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
  };
  EXPECT_GT(distance(kMovingWallColor, kWallColor), 60);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_GT(distance(kMovingWallColor, palette_color(i)), 60) << i;
  }
}

/// Two particles of which one has come onto the other, and one that a wall has entered.
grains::State overlapping() {
  grains::State state = empty_state(24, 20, false);
  state.kinds = {{lattice::Shape::hexagon(2), 0}};
  for (const lattice::Site site : {lattice::Site{6, 6}, {9, 8}, {17, 14}}) {
    grains::Particle particle;
    particle.column = site.column;
    particle.row = site.row;
    state.particles.push_back(particle);
    state.origins.push_back(site);
  }
  state.walls = {moving_wall(state, {14, 14, 30, 16})};
  state.walls[0].passive_rule = grains::PassiveRule::overlap;
  state.pushes = {{1, 0, 0, lattice::Direction::up},
                  {2, grains::wall_code(0), 0, lattice::Direction::down}};
  return state;
}

TEST(Painter, DrawsOverlappingParticlesTheLowerIdOnTop) {
  const grains::State state = overlapping();
  grains::State alone = state;
  alone.particles.resize(1);
  alone.origins.resize(1);
  alone.pushes.clear();
  const Eigen::Vector2d middle = centre(state, state.particles[0]);
  // Inside the lower particle, where it has sites of the other one.
  const lattice::Rectangle view = {middle.x() - 1.9, middle.y() - 1.3, middle.x() + 1.9,
                                   middle.y() + 1.3};
  for (const DrawingMethod drawing : kBothWays) {
    EXPECT_LE(difference_of(picture(state, drawing, 190, 130, 1, view),
                            picture(alone, drawing, 190, 130, 1, view), 2)
                  .differing_pixels,
              20U);
  }
}

TEST(Painter, DrawsOverlapsAlmostTheSameBothWays) {
  grains::State state = overlapping();
  state.particles.resize(2);
  state.origins.resize(2);
  state.pushes.resize(1);
  const Difference difference =
      difference_of(picture(state, DrawingMethod::polygons, 480, 440, 1),
                    picture(state, DrawingMethod::lookup, 480, 440, 1), 2);
  EXPECT_LE(difference.differing_pixels, 480U * 440 / 200);  // outlines beside the overlap
}

TEST(Painter, DrawsAWallInAParticleBothWays) {
  const grains::State state = overlapping();
  const Rgb grain = color_by_id(state).palette[2];
  for (const DrawingMethod drawing : kBothWays) {
    const Image image = picture(state, drawing, 480, 440, 1);
    EXPECT_GT(count_of(image, grain), 1000U);
    EXPECT_GT(count_of(image, kMovingWallColor), 500U);
  }
}

}  // namespace
}  // namespace clca::render::moving_wall_test
