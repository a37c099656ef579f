// A mirrored scene gives mirrored statistics: no left-right bias.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/runs.hpp"

namespace clca {
namespace {

constexpr int kSeeds = 48;

std::vector<double> values(const std::vector<scene::Override>& overrides,
                           const std::string& measure) {
  std::vector<double> result;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    auto all = overrides;
    all.push_back(fmt::format("seed={}", seed));
    const testing::ScratchFolder folder;
    const auto summary =
        run::run(testing::bare_scene("wall-removal", all), {.folder = folder.path()});
    result.push_back(testing::measure_of(summary, "flow", measure));
  }
  return result;
}

class Mirror : public ::testing::TestWithParam<const char*> {};

TEST_P(Mirror, WallRemovalToTheLeftEqualsWallRemovalToTheRight) {
  // 347 columns, an odd number: column c mirrors into 346 - c of the same parity. The wall stands
  // in column 101, its image in 245 at x = 212.18; the fill ends at column 246.
  const std::vector<scene::Override> mirrored = {"walls.right.box=[212, 0, 213, 460]",
                                                 "stages.packing.fill.region=[213, 0, 300, 460]"};
  const auto right = testing::statistics(values({}, GetParam()));
  const auto left = testing::statistics(values(mirrored, GetParam()));
  const double error = std::hypot(right.standard_error, left.standard_error);
  RecordProperty("bias_in_standard_errors",
                 fmt::format("{:.3g}", (right.mean - left.mean) / error));
  EXPECT_LE(std::abs(right.mean - left.mean), 2 * error);
}

INSTANTIATE_TEST_SUITE_P(Measures, Mirror,
                         ::testing::Values("runout_99", "repose_angle_deg", "moved_share"));

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
  const auto result = testing::statistics(differences);
  RecordProperty("bias_in_standard_errors",
                 fmt::format("{:.3g}", result.mean / result.standard_error));
  EXPECT_LE(std::abs(result.mean), 2 * result.standard_error);
}

}  // namespace
}  // namespace clca
