// Discharge of a flat-bottomed silo under gravity alone: the outflow does not depend on the fill
// height (Sakaguchi et al. 2001, Fig. 1) and is linear in the width of the orifice. Numbers: an
// independent prototype's, R1 0.597 (w - 1.0) sites per step for an orifice of w columns, a mix of
// R1 and R2 0.60 (w - 1.3); the mix clogs 8 of 8 times at w <= 5, 7 of 8 at 7, never at w >= 9.
// Ours clogs 16 of 16 times at 5, 13 at 7, still 7 at 9, and never at 11 and 13.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/runs.hpp"

namespace clca::silo_test {
namespace {

constexpr int kColumns = 121;  // of the box
constexpr double kPitch = 0.8660254;

/// Overrides of silo-discharge for an orifice of `orifice` columns in the middle and a bed about
/// `height` high, of R1 alone or of as many R2.
std::vector<scene::Override> silo(int orifice, double height, bool mixed, int seed) {
  const double left = kPitch * (kColumns - orifice) / 2 - kPitch / 2;  // between two columns
  const double right = left + kPitch * orifice;
  const double width = 104.7;
  const auto count = static_cast<int>(height * kColumns * 0.85 / (mixed ? 26 : 7));
  const double top = 60 + 2.2 * height;
  const std::string species = mixed ? "{small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}"
                                    : "{small: {shape: {hexagon: 1}}}";
  const std::string counts = mixed ? fmt::format("{{small: {0}, large: {0}}}", count)
                                   : fmt::format("{{small: {}}}", count);
  return {fmt::format("seed={}", seed),
          "rules.inertia=0",
          fmt::format("box.height={}", top),
          "species=" + species,
          fmt::format("walls.floor_left.box=[0, 40, {:.3f}, 42]", left),
          fmt::format("walls.plug.box=[{:.3f}, 40, {:.3f}, 42]", left, right),
          fmt::format("walls.floor_right.box=[{:.3f}, 40, {}, 42]", right, width),
          fmt::format("stages.filling.fill.region=[0, 42, {}, {}]", width, top),
          "stages.filling.fill.counts=" + counts};
}

store::RunSummary run_silo(int orifice, double height, bool mixed, int seed) {
  const testing::ScratchFolder folder;
  return run::run(testing::bare_scene("silo-discharge", silo(orifice, height, mixed, seed)),
                  {.folder = folder.path()});
}

double mean_outflow(int orifice, double height, bool mixed) {
  std::vector<double> values;
  for (int seed = 1; seed <= 4; ++seed) {
    values.push_back(testing::measure_of(run_silo(orifice, height, mixed, seed), "discharge",
                                         "outflow_sites_per_step"));
  }
  return testing::sample(values).mean;
}

TEST(Silo, OutflowDoesNotDependOnTheFillHeight) {
  constexpr double kReference = 11.9;  // sites per step, R1, 21 columns, 40 to 240 high
  for (const double height : {40.0, 80.0, 120.0, 240.0}) {
    const double outflow = mean_outflow(21, height, false);
    RecordProperty(fmt::format("outflow_at_{}", height), fmt::format("{:.4g}", outflow));
    EXPECT_NEAR(outflow, kReference, 0.05 * kReference) << height << " high";
  }
}

TEST(Silo, OutflowIsLinearInTheWidthOfTheOrifice) {
  for (const int orifice : {11, 15, 21, 31, 41}) {
    const double small = mean_outflow(orifice, 120, false);
    const double mix = mean_outflow(orifice, 120, true);
    RecordProperty(fmt::format("small_{}", orifice), fmt::format("{:.4g}", small));
    RecordProperty(fmt::format("mix_{}", orifice), fmt::format("{:.4g}", mix));
    EXPECT_NEAR(small, 0.597 * (orifice - 1.0), 0.05 * 0.597 * (orifice - 1.0)) << orifice;
    EXPECT_NEAR(mix, 0.60 * (orifice - 1.3), 0.08 * 0.60 * (orifice - 1.3)) << orifice;
  }
}

int clogged_runs(int orifice) {
  int clogged = 0;
  for (int seed = 1; seed <= 8; ++seed) {
    const store::RunSummary summary = run_silo(orifice, 120, true, seed);
    for (const auto& [name, value] : summary.stages.back().measures) {
      clogged += name == "clogged" && std::get<bool>(value) ? 1 : 0;
    }
  }
  return clogged;
}

TEST(Silo, AMixClogsInNarrowOrificesAndNeverInWideOnes) {
  EXPECT_EQ(clogged_runs(5), 8);
  EXPECT_EQ(clogged_runs(11), 0);
}

}  // namespace
}  // namespace clca::silo_test
