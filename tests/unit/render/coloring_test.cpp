#include "clca/render/coloring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <span>
#include <stdexcept>

#include "packed_state.hpp"

namespace clca::render {
namespace {

int distance(Rgb a, Rgb b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
}

automaton::State tower(int particles) {
  automaton::State state = empty_state(9, 10 * particles + 10, false);
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  for (int i = 0; i < particles; ++i) {
    automaton::Particle particle;
    particle.column = 4;
    particle.row = 10 * i + 4;
    particle.kind = i % 2 == 0 ? 0 : 1;
    state.particles.push_back(particle);
    state.origins.push_back(particle.site());
  }
  return state;
}

TEST(Palette, RepeatsAfterEightDistinctColors) {
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(palette_color(i), palette_color(i + 8));
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GT(distance(palette_color(i), palette_color(k)), 60);
    }
  }
}

TEST(ColorMap, RunsFromPurpleToYellowAndStaysThere) {
  EXPECT_EQ(map_color(0), (Rgb{68, 1, 84}));
  EXPECT_EQ(map_color(1), (Rgb{253, 231, 37}));
  EXPECT_EQ(map_color(-3), map_color(0));
  EXPECT_EQ(map_color(INFINITY), map_color(1));
  EXPECT_EQ(map_color(NAN), map_color(0));
}

TEST(ColorMap, GrowsLighterAllTheWay) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Rgb color = map_color(i / 100.0);
    const double lightness = 0.299 * color.red + 0.587 * color.green + 0.114 * color.blue;
    EXPECT_GT(lightness, before - 0.5);
    before = lightness;
  }
}

TEST(Coloring, BySpeciesTakesTheNamedColors) {
  const NamedColor species[] = {{"small", {1, 2, 3}}, {"large", {4, 5, 6}}};
  const Coloring coloring = color_by_species(tower(3), species);
  EXPECT_EQ(coloring.colors, (std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}, {1, 2, 3}}));
  ASSERT_EQ(coloring.legend.patches.size(), 2U);
  EXPECT_EQ(coloring.legend.patches[1].label, "large");
}

TEST(Coloring, BySpeciesFallsBackOnThePalette) {
  const Coloring coloring = color_by_species(tower(2), {});
  EXPECT_EQ(coloring.colors, (std::vector<Rgb>{palette_color(0), palette_color(1)}));
}

TEST(Coloring, ByLayerSetsNeighbouringLayersApart) {
  automaton::State state = tower(8);
  const Coloring coloring = color_by_layer(state, 8);
  ASSERT_EQ(coloring.legend.patches.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(coloring.colors[i], coloring.legend.patches[i].color);
    if (i > 0) {
      EXPECT_GT(distance(coloring.colors[i], coloring.colors[i - 1]), 80);
    }
  }
  state.particles[0].row = 70;  // where it is now does not matter
  EXPECT_EQ(color_by_layer(state, 8).colors, coloring.colors);
}

TEST(Coloring, ByLayerTakesNoneOrEqualHeights) {
  EXPECT_TRUE(color_by_layer(tower(0), 3).colors.empty());
  EXPECT_EQ(color_by_layer(tower(1), 3).colors.size(), 1U);
  EXPECT_THROW(color_by_layer(tower(1), 0), std::invalid_argument);
}

TEST(Coloring, ByDisplacementEndsAtTheTopOfTheBar) {
  automaton::State state = tower(3);
  state.particles[1].row += 5;
  state.particles[2].row -= 50;
  const Coloring coloring = color_by_displacement(state, 10);
  EXPECT_EQ(coloring.colors[0], map_color(0));
  EXPECT_EQ(coloring.colors[1], map_color(0.5));
  EXPECT_EQ(coloring.colors[2], map_color(1));
  ASSERT_EQ(coloring.legend.bars.size(), 1U);
  EXPECT_EQ(coloring.legend.bars[0].high, 10);
  EXPECT_THROW(color_by_displacement(state, 0), std::invalid_argument);
}

TEST(Coloring, ByForceLeavesParticlesWithoutForcePale) {
  const automaton::State state = tower(4);
  const std::vector<double> index = {0, 5, 20, NAN};
  const Coloring coloring = color_by_force(state, index, 10);
  EXPECT_EQ(coloring.colors[1], map_color(0.5));
  EXPECT_EQ(coloring.colors[2], map_color(1));
  EXPECT_EQ(coloring.colors[3], coloring.colors[0]);
  ASSERT_EQ(coloring.legend.patches.size(), 1U);
  EXPECT_EQ(coloring.legend.patches[0].color, coloring.colors[0]);
  for (int i = 0; i <= 100; ++i) {
    EXPECT_GT(distance(coloring.colors[0], map_color(i / 100.0)), 100);
  }
  ASSERT_EQ(coloring.legend.bars.size(), 1U);
  EXPECT_EQ(coloring.legend.bars[0].label, "overlapped sites");
  EXPECT_EQ(coloring.legend.bars[0].low, 0);
  EXPECT_EQ(coloring.legend.bars[0].high, 10);
  EXPECT_THROW(color_by_force(state, index, 0), std::invalid_argument);
  EXPECT_THROW(color_by_force(state, std::span(index).first(3), 10), std::invalid_argument);
}

TEST(Coloring, BySpeedTellsMovingFromResting) {
  automaton::State state = tower(2);
  state.particles[1].previous = 3;
  const Coloring coloring = color_by_speed(state);
  EXPECT_EQ(coloring.colors[1], coloring.legend.patches[0].color);
  EXPECT_EQ(coloring.colors[0], coloring.legend.patches[1].color);
}

TEST(Coloring, ByIdKeepsNeighbouringIdsApart) {
  const Coloring coloring = color_by_id(tower(200));
  for (std::size_t i = 1; i < coloring.colors.size(); ++i) {
    EXPECT_GT(distance(coloring.colors[i], coloring.colors[i - 1]), 30);
  }
}

}  // namespace
}  // namespace clca::render
