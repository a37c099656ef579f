// What is looked up against the definition of a body (body.hpp), sample by sample.
#include "render/site_lookup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "clca/render/painter.hpp"
#include "packed_state.hpp"
#include "render/layout.hpp"
#include "render/wall_appearance.hpp"

namespace clca::render::site_lookup_test {
namespace {

using grains::Owner;

constexpr Owner kSomeWall = -100;
constexpr Owner kMovingWall = -200;

/// Weight of a site at a point `away` from it: one there, none from the next site on, and linear
/// in each lattice triangle between.
double weight(const Eigen::Vector2d& away) {
  const double across = std::abs(away.x()) / lattice::kColumnPitch;
  return 1 - std::max(across, std::abs(away.y()) + across / 2);
}

/// Whose weight counts together at a site, by the words of painter.hpp.
Owner whole_owner(const grains::State& state, const grains::Occupancy& occupancy,
                  lattice::Site site) {
  const lattice::Lattice& lattice = state.lattice;
  const bool beside = !lattice.periodic() && (site.column < 0 || site.column >= lattice.columns());
  if (site.row < 0 || beside) {
    return kSomeWall;
  }
  if (site.row >= lattice.rows()) {
    return grains::kFree;
  }
  const Owner owner = occupancy.owner(lattice.index(site));
  if (!grains::is_wall(owner)) {
    return owner;
  }
  return moves(state.walls[grains::wall_number(owner)]) ? kMovingWall : kSomeWall;
}

struct Expected {
  SampleCode code = 0;
  bool sure = false;  ///< not within rounding of an edge
};

Expected expected_at(const grains::State& state, const grains::Occupancy& occupancy,
                     const Coloring& coloring, const Projection& projection, int x, int y) {
  constexpr double kRounding = 1e-7;
  const Eigen::Vector2d place =
      projection.corner + Eigen::Vector2d(x + 0.5, y + 0.5) / projection.scale;
  std::map<Owner, double> weights;
  const lattice::Site near = lattice::nearest_site(place);
  for (int column = near.column - 2; column <= near.column + 2; ++column) {
    for (int row = near.row - 2; row <= near.row + 2; ++row) {
      const double share = weight(place - lattice::position(lattice::Site{column, row}));
      if (share > 0) {
        weights[whole_owner(state, occupancy, {column, row})] += share;
      }
    }
  }
  Expected result = {code_of(Background::paper), true};
  for (const auto& [owner, sum] : weights) {
    const double inside = sum - 0.5;
    const double edge = projection.outline_width / lattice::kColumnPitch;
    result.sure =
        result.sure && std::abs(inside) > kRounding && std::abs(inside - edge) > kRounding;
    if (inside >= 0 && owner != grains::kFree) {
      const bool outlined = projection.outline_strength > 0 && inside < edge;
      if (grains::is_particle(owner)) {
        const Rgb fill = color(coloring, state, occupancy, grains::particle_id(owner));
        const auto shade = std::find(coloring.palette.begin(), coloring.palette.end(), fill);
        result.code = code_of(static_cast<std::size_t>(shade - coloring.palette.begin()), outlined);
      } else {
        result.code = code_of(owner == kMovingWall ? Background::moving_wall : Background::wall);
      }
    }
  }
  return result;
}

Projection shown(const grains::State& state, int width, int height, int samples,
                 const lattice::Rectangle& view) {
  const Style style = {
      .width = width, .height = height, .view = view, .annotations = Annotations::none};
  const lattice::Rectangle box = completed(style, state.lattice).view;
  return projection_of(box, arrange(width, height, box, Annotations::none), samples, state.lattice,
                       height);
}

/// A coloring that tells all shades apart.
Coloring distinct(const ShadeRule& rule) {
  Coloring coloring;
  coloring.rule = rule;
  for (int shade = 0; shade < 4000; ++shade) {
    coloring.palette.push_back(
        {static_cast<std::uint8_t>(shade / 256), static_cast<std::uint8_t>(shade % 256), 0});
  }
  return coloring;
}

SampleGrid looked_up(const grains::State& state, const Coloring& coloring,
                     const Projection& projection, int threads) {
  SampleGrid grid(projection.width, projection.height);
  SiteLookup(state.lattice, projection, threads)
      .particles(state, grains::Occupancy(state), coloring, grid);
  return grid;
}

void expect_as_defined(const grains::State& state, const Coloring& coloring,
                       const Projection& projection) {
  const grains::Occupancy occupancy(state);
  const SampleGrid grid = looked_up(state, coloring, projection, 1);
  const SampleBox box = projection.samples_in(whole_box(state.lattice));
  std::size_t sure = 0;
  std::size_t wrong = 0;
  for (int x = 0; x < grid.width(); ++x) {
    for (int y = 0; y < grid.height(); ++y) {
      const bool in_box =
          x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
      const Expected expected = in_box ? expected_at(state, occupancy, coloring, projection, x, y)
                                       : Expected{code_of(Background::paper), true};
      sure += expected.sure ? 1U : 0U;
      wrong += expected.sure && grid.at(x, y) != expected.code ? 1U : 0U;
    }
  }
  EXPECT_EQ(wrong, 0U);
  const auto all = static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(grid.height());
  EXPECT_GT(sure, all - all / 100);
}

TEST(SiteLookup, GivesEverySampleTheOwnerOfHalfOfItsWeight) {
  for (const bool periodic : {false, true}) {
    const grains::State state = packed(60, 40, periodic).state();
    const Coloring coloring = distinct(ById{});
    expect_as_defined(state, coloring, shown(state, 300, 200, 1, {}));
    expect_as_defined(state, coloring, shown(state, 60, 50, 2, {-4, -3, 20, 17}));
    expect_as_defined(state, coloring, shown(state, 200, 100, 1, {20.3, 30.2, 28.1, 50}));
    expect_as_defined(state, coloring, shown(state, 31, 17, 1, {}));  // sites between
  }
}

TEST(SiteLookup, TellsShadesByEveryRule) {
  grains::State state = packed(60, 40, true).state();
  const Projection projection = shown(state, 150, 100, 1, {});
  std::vector<double> values;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    values.push_back(0.37 * static_cast<double>(id % 3));
  }
  const std::vector<ShadeRule> rules = {
      BySpecies{}, ByValue{values, {0, 1}}, ByForce{}, ByDisplacement{{0, 15}},
      ByLayer{7, {2, 30}, std::vector<double>(state.kinds.size(), 0.25)}};
  for (const ShadeRule& rule : rules) {
    expect_as_defined(state, distinct(rule), projection);
  }
}

TEST(SiteLookup, ShowsMovingWallsAndTheFirstOwnerWhereTwoOverlap) {
  grains::State state = empty_state(24, 20, false);
  state.kinds = {{lattice::Shape::hexagon(2), 0}};
  for (const lattice::Site site : {lattice::Site{6, 6}, {9, 8}, {17, 14}}) {
    grains::Particle particle;
    particle.column = site.column;
    particle.row = site.row;
    state.particles.push_back(particle);
    state.origins.push_back(site);
  }
  grains::Wall moving;
  moving.sites = lattice::sites_in(state.lattice, {14, 14, 30, 16});
  moving.motion = grains::WallMotion{lattice::Direction::up, grains::Drive{1, 1000}};
  moving.passive = grains::Passive::overlap;
  state.walls = {moving, {lattice::sites_in(state.lattice, {2, 14, 5, 17})}};
  state.pushes = {{1, 0, 0, lattice::Direction::up},
                  {2, grains::wall_code(0), 0, lattice::Direction::down}};
  for (const ShadeRule& rule : {ShadeRule(ById{}), ShadeRule(ByForce{})}) {
    expect_as_defined(state, distinct(rule), shown(state, 240, 220, 1, {}));
  }
}

TEST(SiteLookup, IsTheSameForAnyNumberOfThreads) {
  const grains::State state = packed(120, 90, false).state();
  const Projection projection = shown(state, 320, 240, 2, {});
  const SampleGrid one = looked_up(state, distinct(ById{}), projection, 1);
  for (const int threads : {8, 3, 2}) {  // LLVM's OpenMP loses memory of a team that grows
    SampleGrid some = looked_up(state, distinct(ById{}), projection, threads);
    for (int x = 0; x < one.width(); ++x) {
      for (int y = 0; y < one.height(); ++y) {
        ASSERT_EQ(some.at(x, y), one.at(x, y));
      }
    }
  }
}

TEST(GridPool, GivesAGridToOneAtATimeAndTakesItBack) {
  std::shared_ptr<SampleGrid> kept;
  {
    GridPool pool(30, 20);
    const SampleGrid* first = pool.take().get();
    kept = pool.take();
    EXPECT_EQ(kept.get(), first);
    EXPECT_NE(pool.take().get(), first);
  }
  EXPECT_EQ(kept->width(), 30);  // outlives the pool
}

}  // namespace
}  // namespace clca::render::site_lookup_test
