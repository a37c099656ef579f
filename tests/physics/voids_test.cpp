// The void model where there is a theory for it: one void at a time.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "clca/voids/void_model.hpp"

namespace clca::voids_test {
namespace {

using lattice::Direction;
using lattice::Site;

constexpr int kVoids = 500;   // side by side in one box
constexpr int kColumns = 40;  // for each of them, 4.5 standard deviations to either side
constexpr double kRise = 10;  // of each void, in lattice spacings
constexpr int kRows = 13;

/// A full box that is periodic in x, with voids in its lowest row.
grains::State bed_with_voids(std::uint64_t seed) {
  grains::State state{.lattice = lattice::Lattice(kVoids * kColumns, kRows, true), .seed = seed};
  state.kinds.push_back({lattice::Shape::hexagon(0), 0});
  for (int column = 0; column < state.lattice.columns(); ++column) {
    for (int row = 0; row < kRows; ++row) {
      if (row > 0 || column % kColumns != 0) {
        state.particles.push_back({.column = column, .row = row});
        state.origins.push_back({column, row});
      }
    }
  }
  return state;
}

/// A void and the grain above it with which it has changed places.
Site risen(const voids::VoidModel& model, Site site) {
  const lattice::Lattice& lattice = model.state().lattice;
  for (const Direction direction : {Direction::up, Direction::up_left, Direction::up_right}) {
    const Site above = site + unit(direction);
    if (!model.occupancy().taken(lattice.index(above))) {
      return above;
    }
  }
  return site;
}

/// Half the variance of x over the mean height, of voids that have risen by kRise.
double spreading(double straight, int runs) {
  double squares = 0;
  double heights = 0;
  for (int run = 0; run < runs; ++run) {
    voids::VoidModel model(bed_with_voids(static_cast<std::uint64_t>(run) + 1),
                           {.straight = straight, .sieve = {}});
    std::vector<Site> sites(kVoids);
    for (int i = 0; i < kVoids; ++i) {
      sites[static_cast<std::size_t>(i)] = {i * kColumns, 0};
    }
    for (int step = 0; step < 2 * kRise; ++step) {
      model.step();
      for (Site& site : sites) {
        // One that has risen far enough is followed no more.
        if (lattice::doubled_height(site) < 2 * kRise) {
          site = risen(model, site);
        }
      }
    }
    for (int i = 0; i < kVoids; ++i) {
      const Eigen::Vector2d way = lattice::position(sites[static_cast<std::size_t>(i)]) -
                                  lattice::position(Site{i * kColumns, 0});
      squares += way.x() * way.x();
      heights += way.y();
    }
  }
  return squares / (2 * heights);
}

// A step of a lone void: up by 1 with chance s, else up by 1/2 and to a side by sqrt(3)/2. The mean
// of x² is that of a step times the mean number of steps, also where the walk ends at its first
// step above a height (Wald). So half of it over the height is (1 - s) 3/4 / (1 + s): Litwiniszyn
// 1958 and Mullins 1972, diffusion with the height for time. Standard error with 200,000 paths: 0.3
// %.
TEST(Voids, ALoneVoidSpreadsAsTheTheorySays) {
  constexpr int kRuns = 400;
  for (const double straight : {0.0, 1.0 / 3, 0.678}) {
    const double theory = 0.75 * (1 - straight) / (1 + straight);
    const double measured = spreading(straight, kRuns);
    EXPECT_NEAR(measured / theory, 1, 0.01) << straight << ": " << measured;
    RecordProperty("straight_" + std::to_string(straight), std::to_string(measured));
  }
}

}  // namespace
}  // namespace clca::voids_test
