// A mirrored scene gives mirrored statistics: no left-right bias.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "physics/seeds.hpp"
#include "support/runs.hpp"

namespace clca::mirror_test {
namespace {

constexpr int kSeeds = 48;
/// Bound of a bias in standard errors. Chance goes beyond it once in 4,000 tests (Student's t, 47
/// degrees of freedom).
constexpr double kBound = 4;
constexpr std::array kMeasures = {"runout_99", "repose_angle_deg", "moved_share"};

/// The measures of all seeds, in the order of kMeasures.
std::array<std::vector<double>, kMeasures.size()> values(
    const std::vector<scene::Override>& overrides) {
  std::array<std::vector<double>, kMeasures.size()> result;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    auto all = overrides;
    all.push_back(fmt::format("seed={}", seed));
    const testing::ScratchFolder folder;
    const auto summary =
        run::run(testing::bare_scene("wall-removal", all), {.folder = folder.path()});
    for (std::size_t i = 0; i < kMeasures.size(); ++i) {
      result[i].push_back(testing::measure_of(summary, "flow", kMeasures[i]));
    }
  }
  return result;
}

TEST(Mirror, WallRemovalToTheLeftEqualsWallRemovalToTheRight) {
  // 347 columns, an odd number: column c mirrors into 346 - c of the same parity. The wall stands
  // in column 101, its image in 245 at x = 212.18; the fill ends at column 246.
  const std::vector<scene::Override> mirrored = {"walls.right.box=[212, 0, 213, 460]",
                                                 "stages.packing.fill.region=[213, 0, 300, 460]"};
  const auto to_the_right = values({});
  const auto to_the_left = values(mirrored);
  for (std::size_t i = 0; i < kMeasures.size(); ++i) {
    const auto right = testing::sample(to_the_right[i]);
    const auto left = testing::sample(to_the_left[i]);
    const double bias =
        (right.mean - left.mean) / std::hypot(right.standard_error, left.standard_error);
    testing::expect_within(kMeasures[i], bias, -kBound, kBound);
  }
}

TEST(MirrorHeap, HasTheSameAngleOnBothSides) {
  std::vector<double> differences;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const testing::ScratchFolder folder;
    const auto summary = run::run(testing::bare_scene("heap", {fmt::format("seed={}", seed)}),
                                  {.folder = folder.path()});
    const std::string& stage = summary.stages.back().name;
    differences.push_back(testing::measure_of(summary, stage, "repose_right_deg") -
                          testing::measure_of(summary, stage, "repose_left_deg"));
  }
  const auto result = testing::sample(differences);
  testing::expect_within("bias_in_standard_errors", result.mean / result.standard_error, -kBound,
                         kBound);
}

}  // namespace
}  // namespace clca::mirror_test
