// What is looked up against the definition of a body (body.hpp), sample by sample.
#include "render/site_lookup.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "clca/render/painter.hpp"
#include "packed_state.hpp"
#include "render/colors.hpp"
#include "render/layout.hpp"

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
  if (!grains::is_obstacle(owner)) {
    return owner;
  }
  return is_moving_wall(state.walls[grains::wall_number(owner)]) ? kMovingWall : kSomeWall;
}

struct Expected {
  Rgb color = kPaper;
  bool sure = false;  ///< not within rounding of an edge
};

Expected expected_at(const grains::State& state, const grains::Occupancy& occupancy,
                     const Coloring& coloring, const Projection& projection, int x, int y) {
  constexpr double kRounding = 1e-7;
  const Eigen::Vector2d place =
      projection.corner + Eigen::Vector2d(x + 0.5, y + 0.5) / projection.samples_per_spacing;
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
  Expected result = {kPaper, true};
  for (const auto& [owner, sum] : weights) {
    const double inside = sum - 0.5;
    const double edge = projection.outline_width / lattice::kColumnPitch;
    result.sure =
        result.sure && std::abs(inside) > kRounding && std::abs(inside - edge) > kRounding;
    if (inside >= 0 && owner != grains::kFree) {
      const bool outlined = projection.outline_strength > 0 && inside < edge;
      if (grains::is_particle(owner)) {
        const Rgb fill = coloring.palette[coloring.palette_indices[grains::particle_id(owner)]];
        result.color = outlined ? outline_color(fill, projection.outline_strength) : fill;
      } else {
        result.color = owner == kMovingWall ? kMovingWallColor : kWallColor;
      }
    }
  }
  return result;
}

Projection shown(const grains::State& state, int width, int height, int samples,
                 const lattice::Rectangle& view) {
  const Style style = {
      .width = width, .height = height, .view = view, .annotations = Annotations::none};
  const lattice::Rectangle box = with_view_and_size(style, state.lattice).view;
  return projection_of(box, layout_of(width, height, box, Annotations::none), samples, height);
}

/// A colour of its own for each particle.
Coloring distinct(const grains::State& state) {
  Coloring coloring;
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    coloring.palette_indices.push_back(static_cast<std::uint16_t>(id));
    coloring.palette.push_back(
        {static_cast<std::uint8_t>(id / 256), static_cast<std::uint8_t>(id % 256), 0});
  }
  return coloring;
}

Image looked_up(const grains::State& state, const Coloring& coloring, const Projection& projection,
                int samples, int threads) {
  return SiteLookup(state.lattice, projection, samples, threads)
      .picture(state, grains::Occupancy(state), coloring);
}

/// Sample by sample.
void expect_as_defined(const grains::State& state, const Coloring& coloring,
                       const Projection& projection) {
  const grains::Occupancy occupancy(state);
  const Image image = looked_up(state, coloring, projection, 1, 1);
  const PixelBox box = projection.samples_in(box_with_frame(state.lattice));
  std::size_t sure = 0;
  std::size_t wrong = 0;
  for (int x = 0; x < image.width; ++x) {
    for (int y = 0; y < image.height; ++y) {
      const bool in_box =
          x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
      const Expected expected = in_box ? expected_at(state, occupancy, coloring, projection, x, y)
                                       : Expected{kPaper, true};
      sure += expected.sure ? 1U : 0U;
      wrong += expected.sure && image.at(x, image.height - 1 - y) != expected.color ? 1U : 0U;
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(sure, image.pixels.size() - image.pixels.size() / 100);
}

TEST(SiteLookup, GivesEverySampleTheOwnerOfHalfOfItsWeight) {
  for (const bool periodic : {false, true}) {
    const grains::State state = to_sample(60, 40, periodic).state();
    const Coloring coloring = distinct(state);
    expect_as_defined(state, coloring, shown(state, 300, 200, 1, {}));
    expect_as_defined(state, coloring, shown(state, 60, 50, 2, {-4, -3, 20, 17}));
    expect_as_defined(state, coloring, shown(state, 200, 100, 1, {20.3, 30.2, 28.1, 50}));
    expect_as_defined(state, coloring, shown(state, 31, 17, 1, {}));  // sites between
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
  moving.passive_rule = grains::PassiveRule::overlap;
  state.walls = {moving, {lattice::sites_in(state.lattice, {2, 14, 5, 17})}};
  state.pushes = {{1, 0, 0, lattice::Direction::up},
                  {2, grains::wall_code(0), 0, lattice::Direction::down}};
  expect_as_defined(state, distinct(state), shown(state, 240, 220, 1, {}));
}

TEST(SiteLookup, IsTheSameForAnyNumberOfThreads) {
  const grains::State state = to_sample(120, 90, false).state();
  const Projection projection = shown(state, 320, 240, 2, {});
  const Image one = looked_up(state, distinct(state), projection, 2, 1);
  for (const int threads : {8, 3, 2}) {  // LLVM's OpenMP loses memory of a team that grows
    EXPECT_EQ(looked_up(state, distinct(state), projection, 2, threads), one);
  }
}

TEST(SiteLookup, TakesTheMeanOfTheSamplesOfAPixel) {
  const grains::State state = to_sample(60, 40, false).state();
  const Coloring coloring = distinct(state);
  for (const int samples : {2, 3, 4}) {
    const Projection projection = shown(state, 101, 67, samples, {});
    const Image fine = looked_up(state, coloring, projection, 1, 1);
    const Image image = looked_up(state, coloring, projection, samples, 1);
    ASSERT_EQ(image.width * samples, fine.width);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        std::array<int, 3> sums = {};
        for (int i = 0; i < samples * samples; ++i) {
          const Rgb sample = fine.at(x * samples + i % samples, y * samples + i / samples);
          sums[0] += sample.red;
          sums[1] += sample.green;
          sums[2] += sample.blue;
        }
        const auto mean = [&](int sum) {
          return static_cast<std::uint8_t>((sum + samples * samples / 2) / (samples * samples));
        };
        ASSERT_EQ(image.at(x, y), (Rgb{mean(sums[0]), mean(sums[1]), mean(sums[2])}));
      }
    }
  }
}

}  // namespace
}  // namespace clca::render::site_lookup_test
