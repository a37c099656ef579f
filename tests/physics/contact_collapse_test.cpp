// The wall-removal test by contact dynamics beside discrete elements (bench/peers/references): 540
// grains, small and large 1:1, height/width 1.5, friction 0.4, rolling friction 0.5, restitution
// 0.4. Profiles are those of the project's founders (tests/data).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "physics/seeds.hpp"

namespace clca::contact_collapse_test {
namespace {

constexpr int kSeeds = 8;
constexpr double kWidth = 72;  // L0 of the scene, lattice spacings

/// Means over the seeds; what the flow came to.
struct Collapse {
  double height = 0;  ///< of the column before, over L0
  double slope = 0;   ///< degrees
  double runout = 0;  ///< of 99 %, over L0
  double moved = 0;   ///< share
  int settled = 0;    ///< runs
  std::vector<double> x;
  std::vector<double> profile;

  /// By linear interpolation.
  double profile_at(double place) const {
    const auto right = std::lower_bound(x.begin(), x.end(), place);
    const auto i = static_cast<std::size_t>(right - x.begin());
    const double share = (place - x.at(i - 1)) / (x.at(i) - x.at(i - 1));
    return (1 - share) * profile.at(i - 1) + share * profile.at(i);
  }
};

Collapse collapse(const std::vector<scene::Override>& overrides) {
  Collapse result;
  testing::for_seeds(
      kSeeds, "collapse-contact", overrides, [&](const auto& summary, const auto& folder) {
        const auto mean = [&](const char* stage, const char* measure) {
          return testing::measure_of(summary, stage, measure) / kSeeds;
        };
        result.height += mean("packing", "height_mean") / kWidth;
        result.slope += mean("flow", "repose_angle_deg");
        result.runout += mean("flow", "runout_99") / kWidth;
        result.moved += mean("flow", "moved_share");
        result.settled += summary.stages.back().end_reason == "settled" ? 1 : 0;
        result.x = testing::csv_column(folder / "profile-flow.csv", "x");
        const auto profile = testing::csv_column(folder / "profile-flow.csv", "height_end");
        result.profile.resize(profile.size(), 0);
        for (std::size_t i = 0; i < profile.size(); ++i) {
          result.profile[i] += profile[i] / kSeeds;
        }
      });
  return result;
}

/// Root of the mean square difference to a profile of tests/data, in L0, for x from 0.1 to 2.5 L0.
double distance_to(const std::string& reference, const Collapse& collapse) {
  const std::string file = CLCA_SOURCE_DIR "/tests/data/" + reference;
  const auto x = testing::csv_column(file, "x_over_L0");
  const auto height = testing::csv_column(file, "hfinal_over_L0_mean");
  double squares = 0;
  double count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] >= 0.1 && x[i] <= 2.5) {
      squares += std::pow(collapse.profile_at(x[i] * kWidth) / kWidth - height[i], 2);
      count += 1;
    }
  }
  return std::sqrt(squares / count);
}

using testing::expect_within;

// Discrete elements -/+ 4 degrees and -/+ (0.1 + 10 % of the run-out): two standard deviations of
// single runs of either.
void expect_like_discrete_elements(const std::string& name, const Collapse& result) {
  const double slope = testing::discrete_elements(name, "slope");
  const double runout = testing::discrete_elements(name, "runout");
  expect_within("repose_angle_deg", result.slope, slope - 4, slope + 4);
  expect_within("runout_99_over_L0", result.runout, 0.9 * runout - 0.1, 1.1 * runout + 0.1);
}

TEST(ContactCollapse, WithoutRotationGivesTheProfileOfDiscreteElements) {
  const Collapse result = collapse({"contact.rolling=none"});
  EXPECT_EQ(result.settled, kSeeds);
  expect_within("height_over_L0", result.height, 1.45, 1.57);
  expect_within("profile_rms_over_L0", distance_to("dem_profile_smooth_norot.csv", result), 0,
                0.06);
  expect_like_discrete_elements("collapse-540-none", result);
}

TEST(ContactCollapse, WithRollingResistanceGivesTheProfileOfDiscreteElements) {
  const Collapse result = collapse({"contact.rolling=resistance"});
  EXPECT_EQ(result.settled, kSeeds);
  expect_within("height_over_L0", result.height, 1.42, 1.57);
  expect_within("profile_rms_over_L0", distance_to("dem_profile_smooth_rr.csv", result), 0, 0.07);
  expect_like_discrete_elements("collapse-540-resistance", result);
}

// The first grains never stop on the flat floor, so no run-out; after four fall times the slope is
// that of later times. Fewer move than in discrete elements.
TEST(ContactCollapse, WithFreeRollingHardlyASlopeIsLeft) {
  const Collapse result = collapse({"contact.rolling=free", "stages.flow.until={steps: 2200}"});
  expect_within("repose_angle_deg", result.slope, 3.6, 11.6);
  expect_within("moved_share", result.moved, 0.86, 1);
}

}  // namespace
}  // namespace clca::contact_collapse_test
