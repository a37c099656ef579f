// The flow test of Sakaguchi et al. 2001, Figs. 9 to 11: 540 particles, small and large 1:1, settle
// in a container; then one side wall is removed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "physics/seeds.hpp"

namespace clca::wall_removal_test {
namespace {

constexpr int kSeeds = 16;

/// The measures of kSeeds runs.
class Runs {
 public:
  explicit Runs(const std::vector<scene::Override>& overrides) {
    for (int seed = 1; seed <= kSeeds; ++seed) {
      auto all = overrides;
      all.push_back(fmt::format("seed={}", seed));
      const testing::ScratchFolder folder;
      summaries_.push_back(
          run::run(testing::bare_scene("wall-removal", all), {.folder = folder.path()}));
      x_ = testing::csv_column(folder.path() / "profile-flow.csv", "x");
      const auto profile = testing::csv_column(folder.path() / "profile-flow.csv", "height_end");
      profile_.resize(profile.size(), 0);
      for (std::size_t i = 0; i < profile.size(); ++i) {
        profile_[i] += profile[i] / kSeeds;
      }
    }
  }

  double mean(const std::string& stage, const std::string& measure) const {
    std::vector<double> values;
    for (const auto& summary : summaries_) {
      values.push_back(testing::measure_of(summary, stage, measure));
    }
    return testing::sample(values).mean;
  }
  double mean_steps(const std::string& stage) const {
    double sum = 0;
    for (const auto& summary : summaries_) {
      sum += static_cast<double>(testing::steps_of(summary, stage));
    }
    return sum / kSeeds;
  }
  /// Mean final profile at `x`, by linear interpolation.
  double profile_at(double x) const {
    const auto right = std::lower_bound(x_.begin(), x_.end(), x);
    const auto i = static_cast<std::size_t>(right - x_.begin());
    const double share = (x - x_[i - 1]) / (x_[i] - x_[i - 1]);
    return (1 - share) * profile_[i - 1] + share * profile_[i];
  }

 private:
  std::vector<store::RunSummary> summaries_;
  std::vector<double> x_;
  std::vector<double> profile_;
};

using testing::expect_within;

// Windows: the spread of an independent prototype's runs around its means, for gravity alone and
// 100 columns (height/width 1).
TEST(WallRemoval, WithoutInertiaFallsInTheWindowsOfThePrototype) {
  const Runs runs({"rules.inertia=0"});
  expect_within("settle_steps", runs.mean_steps("packing"), 360, 400);
  expect_within("packing_fraction", runs.mean("packing", "packing_fraction"), 0.81, 0.84);
  expect_within("collapse_steps", runs.mean_steps("flow"), 100, 190);
  expect_within("repose_angle_deg", runs.mean("flow", "repose_angle_deg"), 43, 50);
  expect_within("runout_99", runs.mean("flow", "runout_99"), 27, 32);
  expect_within("unmoved_2", 1 - runs.mean("flow", "moved_share_2"), 0.70, 0.77);
}

constexpr double kNarrow = 70;  // lattice spacings: height/width 1.5 for 540 particles

std::vector<scene::Override> narrow_column(double inertia) {
  return {fmt::format("rules.inertia={}", inertia), "walls.right.box=[70, 0, 71, 460]",
          "stages.packing.fill.region=[0, 0, 70, 460]"};
}

TEST(WallRemoval, DefaultRulesGiveTheProfileOfDiscreteElementsWithoutRotation) {
  const std::string file = CLCA_SOURCE_DIR "/tests/data/dem_profile_smooth_norot.csv";
  const auto x = testing::csv_column(file, "x_over_L0");
  const auto reference = testing::csv_column(file, "hfinal_over_L0_mean");
  const Runs runs(narrow_column(0.9));
  double squares = 0;
  double count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] >= 0.1 && x[i] <= 2.5) {
      squares += std::pow(runs.profile_at(x[i] * kNarrow) / kNarrow - reference[i], 2);
      count += 1;
    }
  }
  expect_within("profile_rms_over_L0", std::sqrt(squares / count), 0, 0.10);
}

// Slope and run-out by inertia at height/width 1.5, 16 seeds, from an independent prototype:
// inertia, slope in degrees, run-out (99 %) over L0. A mean of 16 seeds scatters by up to 1 degree
// and 0.06 L0. The prototype's fit window is not known, and 28 windows (from 5 to 20 % up to 70 to
// 95 % of the height) give means of the same runs that lie 2 degrees apart at inertia 0, 10 at 0.98
// and more at 1: 4 degrees and 0.1 L0 + 5 % allowed.
struct InertiaReference {
  double inertia, slope, runout;
};

/// For the names of the tests.
// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const InertiaReference& reference, std::ostream* stream) {
  *stream << "inertia " << reference.inertia;
}

class InertiaKnob : public ::testing::TestWithParam<InertiaReference> {};

TEST_P(InertiaKnob, SetsSlopeAndRunoutAsInThePrototype) {
  const auto [inertia, slope, runout] = GetParam();
  const Runs runs(narrow_column(inertia));
  expect_within("repose_angle_deg", runs.mean("flow", "repose_angle_deg"), slope - 4, slope + 4);
  const double tolerance = 0.1 + 0.05 * runout;
  expect_within("runout_99_over_L0", runs.mean("flow", "runout_99") / kNarrow, runout - tolerance,
                runout + tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Wall, InertiaKnob,
    ::testing::Values(InertiaReference{0, 47.6, 0.55}, InertiaReference{0.8, 45.5, 0.64},
                      InertiaReference{0.9, 41.8, 0.85}, InertiaReference{0.95, 37.0, 1.20},
                      InertiaReference{0.98, 30.1, 1.83}, InertiaReference{1, 12.2, 2.33}));

}  // namespace
}  // namespace clca::wall_removal_test
