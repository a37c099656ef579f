// A layer on a rough slope, by the contact model: at rest, or in a steady flow whose profile is
// that of Bagnold (1954), 1 - v / v_surface = (1 - y / depth)^(3/2), as in simulations of spheres
// well above the angle of repose (Silbert, Landry & Grest, Phys. Fluids 15, 1 (2003)).

#include <cmath>

#include "clca/run/run.hpp"
#include "physics/seeds.hpp"

namespace clca::contact_chute_test {
namespace {

using testing::expect_within;

struct Profile {
  std::vector<double> y;  ///< above the bed
  std::vector<double> velocity;
};

/// Across the layer up to `top`.
Profile profile(int angle, int top) {
  scene::Scene scene = testing::bare_scene(
      "chute", {fmt::format("let.angle={}", angle), "stages.start.until={steps: 10000}",
                "stages.flow.until={steps: 10000}", fmt::format("lines.depth.to=[52, {}]", top),
                fmt::format("lines.depth.parts={}", (top - 4) / 2)});
  scene.output.series = scene::SeriesOutput{.every = 20};
  const testing::ScratchFolder folder;
  run::run(scene, {.folder = folder.path()});
  const auto file = folder.path() / "lines-flow.csv";
  return {testing::csv_column(file, "position"), testing::csv_column(file, "v_across")};
}

/// Of a fit to the logarithms, without 8 spacings at both ends.
double exponent(const Profile& profile) {
  const double depth = profile.y.back();
  double x_mean = 0;
  double z_mean = 0;
  double xx = 0;
  double xz = 0;
  double count = 0;
  for (std::size_t part = 4; part + 4 < profile.y.size(); ++part) {
    const double x = std::log(1 - profile.y[part] / depth);
    const double z = std::log(1 - profile.velocity[part] / profile.velocity.back());
    x_mean += x;
    z_mean += z;
    xx += x * x;
    xz += x * z;
    ++count;
  }
  return (xz - x_mean * z_mean / count) / (xx - x_mean * x_mean / count);
}

// At 28 degrees, as bench/document-tables measures: 15.19 +- 0.11 by full runs of 4 seeds; 14.99 +-
// 0.16 by 8 seeds of the shorter run here. The exponent was 1.54 +- 0.03 with an older rule.
// Bounds: four of its standard deviations to either side.
TEST(ContactChute, LayersRestOrFlowWithTheProfileOfBagnold) {
  expect_within("velocity_18", profile(18, 24).velocity.back(), -0.001, 0.001);
  const Profile flow = profile(28, 64);
  expect_within("velocity_28", flow.velocity.back(), 14.1, 15.6);
  expect_within("exponent_28", exponent(flow), 1.42, 1.66);
}

}  // namespace
}  // namespace clca::contact_chute_test
