#include <gtest/gtest.h>

#include "clca/render/compare.hpp"
#include "packed_state.hpp"
#include "render/canvas.hpp"
#include "render/lookup_painter.hpp"

namespace clca::render {
namespace {

Image looked_up(const automaton::State& state, int largest_window) {
  const lattice::Rectangle box = whole_box(state.lattice);
  Projection projection;
  projection.width = 300;
  projection.height = 200;
  projection.scale = 300 / (box.right - box.left);
  projection.corner = {box.left, box.bottom};
  projection.anchor = {state.lattice.columns() / 4 * 2, state.lattice.rows() / 2};
  projection.outline_width = 0.2;
  projection.outline_strength = 1;
  Canvas canvas(projection.width, projection.height, 1);
  const Canvas::Session session(canvas);
  canvas.gl().ClearColor(1, 1, 1, 1);
  canvas.gl().Clear(GL_COLOR_BUFFER_BIT);
  LookupPainter painter(canvas.gl(), state.lattice, largest_window);
  const std::vector<Rgb> colors(state.particles.size(), Rgb{200, 100, 0});
  painter.draw(projection, box, automaton::Occupancy(state), colors);
  return canvas.read();
}

TEST(LookupPainter, DrawsALargeLatticeInTilesWithoutSeams) {
  for (const bool periodic : {false, true}) {
    const automaton::State state = packed(60, 40, periodic).state();
    const Image whole = looked_up(state, 0);
    for (const int window : {8, 17, 40}) {
      EXPECT_EQ(compare(looked_up(state, window), whole, 0).pixels, 0U) << window;
    }
  }
}

TEST(SiteTiles, CoverTheAreaOnceWithWindowsThatFit) {
  const lattice::Lattice lattice(100, 70, false);
  const lattice::Rectangle area = {-2.5, -2, 88.25, 70};
  double covered = 0;
  for (const Tile& tile : tiles(lattice, area, 16)) {
    EXPECT_LE(tile.sites.columns(), 16);
    EXPECT_LE(tile.sites.rows(), 16);
    covered += (tile.area.right - tile.area.left) * (tile.area.top - tile.area.bottom);
  }
  EXPECT_NEAR(covered, (area.right - area.left) * (area.top - area.bottom), 1e-9);
  EXPECT_TRUE(tiles(lattice, {5, 5, 4, 9}, 16).empty());
  EXPECT_EQ(tiles(lattice, area, 1000).size(), 1U);
}

}  // namespace
}  // namespace clca::render
