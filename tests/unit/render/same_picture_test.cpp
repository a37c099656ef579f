// Polygons and lookup draw one and the same body: they may differ only where a sample lies on an
// edge, since polygon corners are rounded to 1/256 of a sample.
#include <gtest/gtest.h>

#include "clca/render/difference.hpp"
#include "packed_state.hpp"

namespace clca::render::same_picture_test {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kTolerance = 2;
// One pixel in 1000: of some 60 000 pixels beside an edge or an outline, about one in 256.
constexpr std::size_t kMaxPixels = kWidth * kHeight / 1000;

void expect_same(const grains::State& state, int samples, const lattice::Rectangle& view = {}) {
  const Image polygons = picture(state, DrawingMethod::polygons, kWidth, kHeight, samples, view);
  const Image lookup = picture(state, DrawingMethod::lookup, kWidth, kHeight, samples, view);
  const Difference difference = difference_of(polygons, lookup, kTolerance);
  EXPECT_LE(difference.differing_pixels, kMaxPixels);
  ::testing::Test::RecordProperty("pixels", static_cast<int>(difference.differing_pixels));
}

TEST(Painter, DrawsTheSamePictureBothWays) {
  expect_same(to_sample(121, 90, false).state(), 1);
  expect_same(to_sample(120, 90, false).state(), 2);
}

TEST(Painter, DrawsTheSamePictureBothWaysAcrossAPeriodicSeam) {
  expect_same(to_sample(120, 90, true).state(), 1);
  expect_same(to_sample(60, 40, true).state(), 2);
}

TEST(Painter, DrawsTheSamePictureBothWaysFromNear) {
  expect_same(to_sample(120, 90, false).state(), 1, {40.2, 10.1, 60.7, 25.3});
}

TEST(Painter, DrawsTheSamePictureBothWaysFromFar) {
  expect_same(to_sample(500, 400, false).state(), 2);
}

TEST(Painter, DrawsTheSamePictureBothWaysFarFromTheOrigin) {
  grains::State state = empty_state(200, 100000, false);
  state.kinds = {{lattice::Shape::hexagon(2), 0}};
  for (int i = 0; i < 20; ++i) {
    grains::Particle particle;
    particle.column = 5 + 9 * i;
    particle.row = 99000 + i % 7;
    state.particles.push_back(particle);
    state.origins.push_back(particle.site());
  }
  expect_same(state, 1, {0, 98950, 170, 99050});
}

TEST(Painter, ShowsACrossingParticleAtBothEndsOfAPeriodicBox) {
  grains::State state = empty_state(20, 16, true);
  state.kinds = {{lattice::Shape::hexagon(3), 0}};
  for (const int column : {0, 20, -40}) {
    grains::Particle particle;
    particle.column = column;
    particle.row = 8;
    state.particles = {particle};
    state.origins = {particle.site()};
    for (const DrawingMethod drawing : {DrawingMethod::polygons, DrawingMethod::lookup}) {
      const Image image = picture(state, drawing, 400, 400, 1);
      const int middle = 200;
      const Rgb left = image.at(16, middle);
      EXPECT_NE(left, (Rgb{255, 255, 255}));
      EXPECT_EQ(image.at(383, middle), left);
      EXPECT_EQ(image.at(200, middle), (Rgb{255, 255, 255}));
    }
  }
}

}  // namespace
}  // namespace clca::render::same_picture_test
