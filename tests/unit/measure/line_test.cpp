// What passes a line and how fast, in boxes small enough to count by hand.

#include "clca/measure/line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/states.hpp"

namespace clca::measure::line_test {
namespace {

using grains::State;
using lattice::Shape;

/// Particles of one shape, at rest where they are.
State box_of(const std::vector<lattice::Site>& sites, const Shape& shape = Shape::hexagon(0),
             bool periodic = false) {
  State state{.lattice = lattice::Lattice(20, 20, periodic)};
  state.kinds = {{shape, 0}};
  for (const lattice::Site site : sites) {
    state.particles.push_back(testing::particle_at(site.column, site.row));
  }
  state.origins = sites;
  return state;
}

/// What the line sees of a state and, `steps` later, of another one.
std::vector<LinePart> seen(const Line& line, const State& before, State now,
                           std::uint64_t steps = 1) {
  now.step = before.step + steps;
  const Snapshot snapshot(before);
  LineSums sums(line.part_count());
  line.observe(snapshot, now, grains::Occupancy(now), snapshot.velocities(now), sums);
  return line.part_means(sums);
}

/// Sites that have passed a line of this length.
double passed(const std::vector<LinePart>& parts, double length, double steps = 1) {
  const double flux =
      std::accumulate(parts.begin(), parts.end(), 0.0,
                      [](double sum, const LinePart& part) { return sum + part.flux.mean; });
  return flux * length / static_cast<double>(parts.size()) * steps;
}

/// From left to right at the height of 5.2, between the sites.
Line level(const State& state, double from, double to, std::size_t parts = 1) {
  return {state, {from, 5.2}, {to, 5.2}, parts};
}

TEST(Line, AGrainThatComesToTheLineHasNotPassedItInAnyImage) {
  for (int image = -40; image <= 40; ++image) {
    const State before = box_of({{20 * image - 1, 6}}, Shape::hexagon(0), true);
    State now = before;
    now.particles[0].column += 1;
    const Line line(now, {0, 0}, {0, 10}, 1);
    EXPECT_EQ(passed(seen(line, before, now), 10), 0) << image;
    State on = now;
    on.particles[0].column += 1;
    EXPECT_NEAR(std::abs(passed(seen(line, now, on), 10)), 1, 1e-12) << image;
  }
}

TEST(Line, CountsSitesThatPassToTheRightLessThoseToTheLeft) {
  const State before = box_of({{2, 6}, {4, 6}, {6, 4}, {8, 9}});
  State now = before;
  now.particles[0].row = 4;
  now.particles[1].row = 4;
  EXPECT_NEAR(passed(seen(level(now, 0, 15), before, now), 15), 2, 1e-12);
  now.particles[2].row = 7;  // upwards
  now.particles[3].row = 7;  // not as far
  const auto parts = seen(level(now, 0, 15), before, now, 4);
  EXPECT_NEAR(passed(parts, 15, 4), 1, 1e-12);
  EXPECT_EQ(parts.front().passed_particles, 3U) << "either way";
  const Line back(now, {15, 5.2}, {0, 5.2}, 1);
  EXPECT_NEAR(passed(seen(back, before, now), 15), -1, 1e-12);
}

TEST(Line, FindsTheRightSideOfAnyDirection) {
  const State before = box_of({{4, 10}});
  State now = before;
  now.particles[0].column = 6;  // x from 3.46 to 5.20
  const Line up(now, {4.2, 5}, {4.2, 15}, 1);
  const Line slope(now, {0, 6}, {8, 14}, 1);  // x = y - 6
  EXPECT_NEAR(passed(seen(up, before, now), 10), 1, 1e-12);
  EXPECT_NEAR(passed(seen(slope, before, now), std::sqrt(128)), 1, 1e-12);
  EXPECT_NEAR(seen(up, before, now, 2).front().flux.mean, 1.0 / 20, 1e-12);
}

TEST(Line, CountsEachSiteOfAParticleInThePartWhereItPasses) {
  const State before = box_of({{10, 9}}, Shape::hexagon(1));
  State now = before;
  now.particles[0].row = 2;
  // Columns 9 to 11 have 2, 3 and 2 sites and stand at 7.79, 8.66 and 9.53.
  const auto parts = seen(level(now, 0, 15, 5), before, now);
  EXPECT_NEAR(parts[2].flux.mean * 3, 2 * 1 + 3 * 0.8397 + 2 * 0, 0.08);
  EXPECT_NEAR(passed(parts, 15), 7, 1e-12);
  EXPECT_EQ(parts[2].passed_particles, 1U);
  EXPECT_EQ(parts[3].passed_particles, 0U);
}

TEST(Line, CountsAParticleThroughTheCommonEndOfTwoLinesOnce) {
  const State before = box_of({{4, 6}});
  State now = before;
  now.particles[0].row = 4;
  const double x = 4 * lattice::kColumnPitch;
  EXPECT_NEAR(passed(seen(level(now, x, 15), before, now), 15 - x), 1, 1e-12);
  EXPECT_EQ(passed(seen(level(now, 0, x), before, now), x), 0);
}

TEST(Line, FollowsAPathAcrossThePeriodicBoundary) {
  const State before = box_of({{18, 6}}, Shape::hexagon(0), true);
  State now = before;
  now.particles[0].column = 25;  // column 5 of the box
  now.particles[0].row = 4;      // through the line at column 1.7
  const double width = now.lattice.extent().x();
  EXPECT_NEAR(passed(seen(level(now, 0, 5), before, now), 5), 1, 1e-12);
  EXPECT_EQ(passed(seen(level(now, 5, width), before, now), width - 5), 0);
  State round = box_of({{60, 6}}, Shape::hexagon(0), true);  // in column 0, where the line starts
  const State start = round;
  round.particles[0].row = 4;
  EXPECT_NEAR(passed(seen(level(now, 0, width), start, round), width), 1, 1e-12);
  now.particles[0].column = 18 + 40;  // twice around
  now.particles[0].row = 6;
  const Line up(now, {4.2, 5}, {4.2, 15}, 1);
  EXPECT_NEAR(passed(seen(up, before, now), 10), 2, 1e-12);
}

TEST(Line, CountsWhatHasEnteredOrLeftSince) {
  State before = box_of({{0, 6}, {2, 6}});
  before.particles[1].present = false;  // removed earlier
  State now = before;
  now.particles[0].row = 1;
  now.particles[0].present = false;  // removed below the line
  now.particles.push_back(testing::particle_at(4, 2));
  now.origins.push_back({4, 9});  // came in above it
  now.particles.push_back(testing::particle_at(6, 2));
  now.origins.push_back({6, 3});  // below
  EXPECT_NEAR(passed(seen(level(now, 0, 15), before, now), 15), 2, 1e-12);
}

TEST(Line, AveragesTheVelocitiesOfWhatItCutsOverItsLength) {
  // The line cuts a hexagon of 5 columns that sinks and one of 3 that rests.
  State before = box_of({{4, 9}, {12, 5}}, Shape::hexagon(2));
  before.kinds.push_back({Shape::hexagon(1), 0});
  before.particles[1].kind = 1;
  State now = before;
  now.particles[0].row = 5;
  now.particles[0].column = 5;
  const auto part = seen(level(now, 0, 17), before, now, 2).front();
  EXPECT_NEAR(part.covered_share, 8 * lattice::kColumnPitch / 17, 0.02);
  EXPECT_NEAR(part.across_velocity.mean, 1.75 * 5 / 8, 0.05);  // 3.5 spacings down in 2 steps
  EXPECT_NEAR(part.along_velocity.mean, 0.433 * 5 / 8, 0.02);
}

TEST(Line, LeavesWallsOutOfTheFilling) {
  State state = box_of({{4, 5}});
  state.walls = {{.sites = {{0, 5}, {1, 5}, {2, 5}, {3, 5}}}};
  const auto parts = seen(level(state, 0, 10, 2), state, state);
  // One column of what four leave of 5 spacings, to a point of 8.
  EXPECT_NEAR(parts[0].covered_share, lattice::kColumnPitch / (5 - 3.5 * lattice::kColumnPitch),
              0.07);
  EXPECT_EQ(seen(level(state, 0, 2), state, state).front().covered_share, 0);
}

TEST(Line, HasNoVelocityWhereNothingIsOnIt) {
  const State state = box_of({});
  const auto part = seen(level(state, 0, 10), state, state).front();
  EXPECT_TRUE(std::isnan(part.across_velocity.mean));
  EXPECT_TRUE(std::isnan(part.along_velocity.mean));
  EXPECT_EQ(part.flux.mean, 0);
}

TEST(Line, TakesItsErrorFromTheScatterOfBlocks) {
  const State upper = box_of({{2, 6}});
  const Line line = level(upper, 0, 10);
  LineSums sums(1);
  Snapshot before(upper);
  State now = upper;
  for (int i = 0; i < 100; ++i) {
    now.step += 1;
    now.particles[0].row = now.particles[0].row == 6 && i % 4 == 0 ? 4 : 6;
    line.observe(before, now, grains::Occupancy(now), before.velocities(now), sums);
    before = Snapshot(now);
    EXPECT_LE(sums.blocks().size(), LineSums::kMaxBlocks);
    EXPECT_EQ(std::isnan(line.part_means(sums).front().flux.standard_error), i + 1 < 8) << i;
  }
  EXPECT_EQ(sums.blocks().size(), 13U) << "of 8 observations";
  EXPECT_TRUE(sums.fits_part_count(1));
  EXPECT_FALSE(sums.fits_part_count(2));
  EXPECT_NEAR(line.part_means(sums).front().flux.mean, 0, 1e-12);
  EXPECT_NEAR(line.part_means(sums).front().flux.standard_error, 0, 1e-12)
      << "all blocks are alike";
}

TEST(LineSums, JoinBlocksInPairs) {
  LineSums sums(1);
  for (int i = 0; i < 40; ++i) {
    sums.begin_observation(1).parts[0].sites += i;
  }
  double total = 0;
  for (const LineBlock& block : sums.blocks()) {
    EXPECT_EQ(block.observations, 4U);
    total += block.parts[0].sites;
  }
  EXPECT_EQ(sums.blocks().size(), 10U);
  EXPECT_EQ(sums.blocks().front().parts[0].sites, 0 + 1 + 2 + 3);
  EXPECT_EQ(total, 39 * 40 / 2);
}

TEST(LineSums, HasTheStandardErrorOfIndependentBlocks) {
  const State state = box_of({});
  const Line line = level(state, 0, 10);
  LineSums sums(1);
  for (int i = 0; i < 10; ++i) {
    sums.begin_observation(2).parts[0].sites += i % 2;
  }
  const statistics::SampleStatistics flux = line.part_means(sums).front().flux;
  EXPECT_NEAR(flux.mean, 0.5 / 20, 1e-12);
  EXPECT_NEAR(flux.standard_error, 0.5 / 20 / std::sqrt(9.0), 1e-12);
}

TEST(Line, RefusesWhatItCannotMeasure) {
  const State state = box_of({});
  EXPECT_THROW(Line(state, {1, 1}, {1, 1}, 1), std::invalid_argument);
  EXPECT_THROW(Line(state, {1, 1}, {5, 1}, 0), std::invalid_argument);
  EXPECT_THROW(seen(level(state, 0, 10), state, state, 0), std::invalid_argument);
  const State other{.lattice = lattice::Lattice(10, 20, false)};
  LineSums sums(1);
  State now = state;
  now.step = 1;
  EXPECT_THROW(
      level(state, 0, 10).observe(Snapshot(state), now, grains::Occupancy(other), {}, sums),
      std::invalid_argument);
}

}  // namespace
}  // namespace clca::measure::line_test
