// The void model where there is a theory for it: one void at a time.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "clca/random/draw.hpp"
#include "clca/voids/void_model.hpp"

namespace clca::voids_test {
namespace {

using lattice::Direction;
using lattice::Site;

constexpr int kVoids = 500;   // side by side in one box
constexpr int kColumns = 40;  // for each of them, 4.5 standard deviations to either side
constexpr double kRise = 10;  // of each void, in lattice spacings
constexpr int kRows = 13;

constexpr int kSieveColumns = 30;
constexpr int kSieveRows = 30;

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
    if (!model.occupancy().is_taken(lattice.index(above))) {
      return above;
    }
  }
  return site;
}

/// The ways of voids that have risen by kRise.
std::vector<lattice::Axial> ways(double straight, int runs) {
  std::vector<lattice::Axial> result;
  for (int run = 0; run < runs; ++run) {
    voids::VoidModel model(bed_with_voids(static_cast<std::uint64_t>(run) + 1),
                           {.straight_weight = straight, .sieve_factors = {}});
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
      result.push_back(sites[static_cast<std::size_t>(i)] - Site{i * kColumns, 0});
    }
  }
  return result;
}

/// Half the variance of x over the mean height, of voids that have risen by kRise.
double spreading(double straight, int runs) {
  double squares = 0;
  double heights = 0;
  for (const lattice::Axial way : ways(straight, runs)) {
    const Eigen::Vector2d at = lattice::position(way);
    squares += at.x() * at.x();
    heights += at.y();
  }
  return squares / (2 * heights);
}

/// Litwiniszyn 1958: the probability of a void is passed on by the weights, without draws. By
/// columns to the right, where it comes to kRise.
std::map<int, double> recursion(double straight) {
  std::map<std::pair<int, int>, double> at = {{{0, 0}, 1}};  // by doubled height and column
  std::map<int, double> arrived;
  while (!at.empty()) {
    const auto [place, chance] = *at.begin();
    const auto [height, column] = place;
    at.erase(at.begin());
    if (height >= 2 * kRise) {
      arrived[column] += chance;
      continue;
    }
    at[{height + 2, column}] += chance * straight;
    at[{height + 1, column - 1}] += chance * (1 - straight) / 2;
    at[{height + 1, column + 1}] += chance * (1 - straight) / 2;
  }
  return arrived;
}

// A step of a lone void: up by 1 with chance s, else up by 1/2 and to a side by sqrt(3)/2. The mean
// of x² is that of a step times the mean number of steps, also where the walk ends at its first
// step above a height (Wald). So half of it over the height is (1 - s) 3/4 / (1 + s): Litwiniszyn
// 1958 and Mullins 1972, diffusion with the height for time. Standard error with 50,000 paths: 0.6
// %; four of them are allowed.
TEST(Voids, ALoneVoidSpreadsAsTheTheorySays) {
  constexpr int kRuns = 100;
  for (const double straight : {0.0, 1.0 / 3, 0.678}) {
    const double theory = 0.75 * (1 - straight) / (1 + straight);
    const double measured = spreading(straight, kRuns);
    EXPECT_NEAR(measured / theory, 1, 0.025) << straight << ": " << measured;
    RecordProperty("straight_" + std::to_string(straight), std::to_string(measured));
  }
}

TEST(Voids, ALoneVoidIsWhereLitwiniszynsRecursionHasIt) {
  constexpr int kRuns = 100;
  std::map<int, int> counts;
  for (const lattice::Axial way : ways(1.0 / 3, kRuns)) {
    ++counts[way.x];
  }
  constexpr double kPaths = kRuns * kVoids;
  for (const auto& [column, chance] : recursion(1.0 / 3)) {
    // Five standard errors, and one path where hardly any comes.
    const double error = std::sqrt(chance / kPaths);
    EXPECT_NEAR(counts[column] / kPaths, chance, 5 * error + 1 / kPaths) << column;
  }
}

/// How far the large grains lie above the small ones: 1 if above all of them, 0 if mixed.
double lift(const grains::State& state) {
  std::array<double, 2> heights{};
  for (const grains::Particle& grain : state.particles) {
    heights[grain.kind] += lattice::position(grain.site()).y();
  }
  const auto half = static_cast<double>(state.particles.size()) / 2;
  return (heights[1] - heights[0]) / half / (kSieveRows / 2.0);
}

/// A random mixture of two species in a periodic box; then a column at a time is pushed up by a
/// site.
double lift_after(double sieve, std::uint64_t seed, int pushes) {
  std::mt19937_64 random(seed);
  grains::State state{.lattice = lattice::Lattice(kSieveColumns, kSieveRows + 10, true),
                      .seed = seed};
  state.kinds = {{lattice::Shape::hexagon(0), 0}, {lattice::Shape::hexagon(0), 1}};
  for (int i = 0; i < kSieveColumns * kSieveRows; ++i) {
    state.particles.push_back({.column = i % kSieveColumns,
                               .row = i / kSieveColumns,
                               .kind = static_cast<std::uint16_t>(i % 2)});
  }
  for (std::size_t i = state.particles.size() - 1; i > 0; --i) {
    std::swap(state.particles[i].kind,
              state.particles[random::uniform_below(random(), i + 1)].kind);
  }
  for (const grains::Particle& grain : state.particles) {
    state.origins.push_back(grain.site());
  }
  for (int push = 0; push < pushes; ++push) {
    const auto column = static_cast<int>(random::uniform_below(random(), kSieveColumns));
    for (grains::Particle& grain : state.particles) {
      grain.row += state.lattice.wrapped(grain.column) == column ? 1 : 0;
    }
    voids::VoidModel model(state, {.straight_weight = 1.0 / 3, .sieve_factors = {1, sieve}});
    for (int step = 0; step < 10; ++step) {
      model.step();
    }
    state = model.state();
  }
  return lift(state);
}

// A reading of Savage 1993: no number of his is known to us. Those here are of a prototype of the
// same rule, written before it in another language: -0.01 ± 0.03, 0.88 ± 0.01, 0.988 ± 0.005 over 3
// seeds. Tolerance: three standard deviations, at least 0.015.
TEST(Voids, ASieveLiftsTheGrainsThatAreHarderToTake) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    EXPECT_NEAR(lift_after(1, seed, 2000), 0, 0.1);
    EXPECT_NEAR(lift_after(0.5, seed, 2000), 0.88, 0.03);
    EXPECT_NEAR(lift_after(0.25, seed, 2000), 0.988, 0.015);
  }
}

}  // namespace
}  // namespace clca::voids_test
