#include "clca/render/coloring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "clca/render/body.hpp"
#include "packed_state.hpp"

namespace clca::render::coloring_test {
namespace {

int distance(Rgb a, Rgb b) {
  return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
}

grains::State tower(int particles) {
  grains::State state = empty_state(9, 10 * particles + 10, false);
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  for (int i = 0; i < particles; ++i) {
    grains::Particle particle;
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
  EXPECT_EQ(viridis_color(0), (Rgb{68, 1, 84}));
  EXPECT_EQ(viridis_color(1), (Rgb{253, 231, 37}));
  EXPECT_EQ(viridis_color(-3), viridis_color(0));
  EXPECT_EQ(viridis_color(INFINITY), viridis_color(1));
  EXPECT_EQ(viridis_color(NAN), viridis_color(0));
}

TEST(ColorMap, GrowsLighterAllTheWay) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Rgb color = viridis_color(i / 100.0);
    const double lightness = 0.299 * color.red + 0.587 * color.green + 0.114 * color.blue;
    EXPECT_GT(lightness, before - 0.5);
    before = lightness;
  }
}

std::vector<Rgb> colors_of(const Coloring& coloring) {
  std::vector<Rgb> colors;
  for (const std::uint16_t shade : coloring.palette_indices) {
    colors.push_back(coloring.palette[shade]);
  }
  return colors;
}

TEST(Coloring, BySpeciesTakesTheNamedColors) {
  const std::vector<NamedColor> species = {{"small", {1, 2, 3}}, {"large", {4, 5, 6}}};
  const grains::State state = tower(3);
  const Coloring coloring = color_by_species(state, species);
  EXPECT_EQ(colors_of(coloring), (std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}, {1, 2, 3}}));
  ASSERT_EQ(coloring.legend.patches.size(), 2U);
  EXPECT_EQ(coloring.legend.patches[1].label, "large");
}

TEST(Coloring, BySpeciesFallsBackOnThePalette) {
  const grains::State state = tower(2);
  EXPECT_EQ(colors_of(color_by_species(state, {})),
            (std::vector<Rgb>{palette_color(0), palette_color(1)}));
}

TEST(Coloring, ByLayerSetsNeighbouringLayersApart) {
  grains::State state = tower(8);
  const Coloring coloring = color_by_layer(state, 8, layer_range(state));
  const std::vector<Rgb> colors = colors_of(coloring);
  ASSERT_EQ(coloring.legend.patches.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(colors[i], coloring.legend.patches[i].color);
    if (i > 0) {
      EXPECT_GT(distance(colors[i], colors[i - 1]), 80);
    }
  }
  const LayerRange range = layer_range(state);
  state.particles[0].row = 84;  // where it is now does not matter
  EXPECT_EQ(colors_of(color_by_layer(state, 8, range)), colors);
}

TEST(Coloring, ByLayerGivesThoseOutsideOfTheRangeTheNearestLayer) {
  const grains::State state = tower(8);
  const LayerRange range = {30, 60};
  const std::vector<Rgb> colors = colors_of(color_by_layer(state, 3, range));
  EXPECT_EQ(colors[0], colors[3]);
  EXPECT_EQ(colors[7], colors[6]);
  EXPECT_NE(colors[0], colors[7]);
}

TEST(Coloring, ByLayerTakesNoneOrEqualHeights) {
  EXPECT_TRUE(colors_of(color_by_layer(tower(0), 3, {})).empty());
  const grains::State one = tower(1);
  const Coloring coloring = color_by_layer(one, 3, layer_range(one));
  EXPECT_EQ(colors_of(coloring), std::vector<Rgb>{coloring.palette[0]});
  EXPECT_THROW(color_by_layer(one, 0, {}), std::invalid_argument);
}

TEST(Coloring, LayersReachToWhereSourcesEmit) {
  grains::State state = tower(2);
  const LayerRange alone = layer_range(state);
  state.sources.resize(2);
  state.sources[0].sites = {{4, 25}, {4, 28}};
  state.sources[0].weights = {0, 1};
  state.sources[1] = state.sources[0];
  state.sources[1].sites = {{4, 2}};
  const std::vector<std::size_t> first = {0};
  EXPECT_EQ(layer_range(state).high, alone.high);
  EXPECT_EQ(layer_range(state, first).low, alone.low);
  EXPECT_EQ(layer_range(state, first).high, 28.0);
}

TEST(Coloring, ByDisplacementEndsAtTheTopOfTheBar) {
  grains::State state = tower(3);
  state.particles[1].row += 5;
  state.particles[2].row += 13;
  const Coloring coloring = color_by_displacement(state, {0, 10});
  const std::vector<Rgb> colors = colors_of(coloring);
  EXPECT_EQ(colors[0], viridis_color(0));
  EXPECT_EQ(colors[1], viridis_color(0.5));
  EXPECT_EQ(colors[2], viridis_color(1));
  ASSERT_EQ(coloring.legend.bars.size(), 1U);
  EXPECT_EQ(coloring.legend.bars[0].high, 10);
  EXPECT_THROW(color_by_displacement(state, {0, 0}), std::invalid_argument);
}

TEST(Coloring, MarksTheEndsOfTheBarBeyondWhichValuesLie) {
  grains::State state = tower(3);
  state.particles[1].row += 5;
  state.particles[2].row += 13;
  const auto marks = [&](const statistics::Range& range) {
    const Legend::ColorBar bar = color_by_displacement(state, range).legend.bars[0];
    return std::pair(bar.below, bar.above);
  };
  EXPECT_EQ(marks({0, 13}), std::pair(false, false));
  EXPECT_EQ(marks({0, 12}), std::pair(false, true));
  EXPECT_EQ(marks({1, 13}), std::pair(true, false));
  state.particles[2].present = false;
  EXPECT_EQ(marks({0, 12}), std::pair(false, false));
}

TEST(Coloring, BySpeciesHasTheShapesAsIcons) {
  grains::State state = empty_state(4, 4, false);
  state.kinds = {{lattice::Shape::hexagon(1), 0},
                 {lattice::Shape::hexagon(4), 1},
                 {lattice::Shape::hexagon(2), 1}};
  const std::vector<NamedColor> species = {
      {"small", {1, 2, 3}}, {"large", {4, 5, 6}}, {"none", {}}};
  const std::vector<Legend::Patch> icons = color_by_species(state, species).legend.patches;
  ASSERT_EQ(icons.size(), 3U);
  EXPECT_LT(icons[0].size, 1);
  EXPECT_GE(icons[0].size, 0.5);
  EXPECT_EQ(icons[1].size, 1);
  EXPECT_EQ(icons[1].outline.size(), outline(state.kinds[1].shape).size());
  EXPECT_TRUE(icons[2].outline.empty());
}

TEST(Coloring, ByDisplacementHasTheColorsOfTheMapToOneStepOfAChannel) {
  grains::State state = empty_state(4, 400, false);
  state.kinds = {{lattice::Shape::hexagon(0), 0}};
  for (int row = 0; row < 350; ++row) {
    grains::Particle particle;
    particle.row = row;
    state.particles.push_back(particle);
    state.origins.push_back({0, 0});
  }
  const std::vector<Rgb> colors = colors_of(color_by_displacement(state, {0, 333}));
  for (int row = 0; row < 350; ++row) {
    EXPECT_LE(distance(colors[static_cast<std::size_t>(row)], viridis_color(row / 333.0)), 3);
  }
}

/// Hexagons of radius 1 in a row, one pushed onto its left neighbour by so many columns.
grains::State pushed_row() {
  grains::State state = empty_state(40, 10, false);
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  for (const int column : {2, 4, 10, 11, 20}) {
    grains::Particle particle;
    particle.column = column;
    particle.row = 4;
    state.particles.push_back(particle);
    state.origins.push_back(particle.site());
  }
  grains::Wall wall;
  wall.sites = {{20, 4}, {21, 4}};
  wall.motion = grains::WallMotion{lattice::Direction::up, grains::Drive{1, 1000}};
  wall.passive_rule = grains::PassiveRule::overlap;
  state.walls = {wall};
  state.pushes = {{1, 0, 0, lattice::Direction::up},
                  {3, 2, 0, lattice::Direction::up},
                  {4, grains::wall_code(0), 0, lattice::Direction::up}};
  return state;
}

TEST(Coloring, ByForceCountsTheSitesThatAParticleShares) {
  const grains::State state = pushed_row();
  const Coloring coloring = color_by_force(state, grains::Occupancy(state), {0, 3});
  // Two columns apart hexagons of radius 1 share 2 sites, next to each other 4; two of the wall.
  const std::vector<Rgb> colors = colors_of(coloring);
  ASSERT_EQ(colors.size(), 5U);
  for (const std::size_t id : {0U, 1U, 4U}) {
    EXPECT_LE(distance(colors[id], viridis_color(2 / 3.0)), 2) << id;
  }
  EXPECT_EQ(colors[2], viridis_color(1));
  EXPECT_EQ(colors[3], viridis_color(1));
}

TEST(Coloring, ByForceLeavesParticlesWithoutForcePale) {
  const grains::State state = tower(4);
  const Coloring coloring = color_by_force(state, grains::Occupancy(state), {0, 10});
  ASSERT_EQ(coloring.legend.patches.size(), 1U);
  for (const Rgb color : colors_of(coloring)) {
    EXPECT_EQ(color, coloring.legend.patches[0].color);
  }
  for (int i = 0; i <= 100; ++i) {
    EXPECT_GT(distance(coloring.palette[0], viridis_color(i / 100.0)), 100);
  }
  ASSERT_EQ(coloring.legend.bars.size(), 1U);
  EXPECT_EQ(coloring.legend.bars[0].label, "overlapped sites");
  EXPECT_EQ(coloring.legend.bars[0].low, 0);
  EXPECT_EQ(coloring.legend.bars[0].high, 10);
  EXPECT_THROW(color_by_force(state, grains::Occupancy(state), {0, 0}), std::invalid_argument);
}

TEST(Coloring, ByValueHasTheColoursOfItsBar) {
  const grains::State state = tower(3);
  const Coloring coloring = color_by_value(state, {-1, 5, 10}, "speed (m/s)", {0, 10});
  const std::vector<Rgb> colors = colors_of(coloring);
  EXPECT_EQ(colors[0], viridis_color(0));
  EXPECT_EQ(colors[1], viridis_color(0.5));
  EXPECT_EQ(colors[2], viridis_color(1));
  EXPECT_EQ(coloring.legend.bars[0].label, "speed (m/s)");
}

TEST(Coloring, OfNumbersWithASignIsSymmetricAboutZero) {
  const grains::State state = tower(3);
  for (const statistics::Range range : {statistics::Range{-2, 2}, statistics::Range{-1, 2}}) {
    const Coloring coloring = color_by_value(state, {0, 2, -1}, "spin", range, true);
    const std::vector<Rgb> colors = colors_of(coloring);
    EXPECT_LE(distance(colors[0], {221, 221, 221}), 2);
    EXPECT_EQ(colors[1], diverging_color(1));
    EXPECT_LE(distance(colors[2], diverging_color(-0.5)), 2);
  }
}

TEST(Coloring, ByIdKeepsNeighbouringIdsApartEvenWhereColorsBeginAgain) {
  const std::vector<Rgb> palette = color_by_id(tower(1)).palette;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    EXPECT_GT(distance(palette[i], palette[(i + 1) % palette.size()]), 30) << i;
  }
}

}  // namespace
}  // namespace clca::render::coloring_test
