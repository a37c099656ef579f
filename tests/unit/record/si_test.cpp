// Forces, loads and stress in SI units, in tables and pictures; forces across and along a wall.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "clca/image/png.hpp"
#include "clca/run/run.hpp"
#include "clca/store/table.hpp"
#include "support/runs.hpp"

namespace clca::record::si_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kHopper = R"(clca: 1
model: contact
seed: 3
box: {width: 60, height: 80}
species: {small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}
walls:
  left: {line: {from: [0, 30], to: [25, 4], thickness: 2}}
  right: {line: {from: [35, 4], to: [60, 30], thickness: 2}}
  gate: {box: [24, 2, 36, 4]}
  both: {parts: [{box: [2, 70, 10, 72]}, {box: [2, 70, 4, 79]}]}
stages:
  - name: rest
    fill: {region: [0, 31, 60, 69], counts: {small: 60, large: 60}}
    until: {steps: 3000}
measure: [force]
output: {frames: {every: 100000, width: 320, color_by: force, overlay: forces}}
)";
constexpr const char* kDensity = "units={spacing: 2 mm, gravity: 10, density: 40}";
constexpr double kSiteWeight = 40 * 0.8660254037844386 * 0.002 * 0.002 * 10;  // N
constexpr double kMeanMass = (7 + 19) / 2.0;                                  // sites

class Si : public ::testing::Test {
 protected:
  fs::path path(const char* run) const { return folder.path() / run; }
  void run_of(const char* name, const std::vector<scene::Override>& overrides) const {
    run::run(scene::parse(kHopper, "scene.yaml", overrides), {.folder = path(name)});
  }
  store::ParsedTable table(const char* run, const char* name) const {
    return store::read_table(path(run) / name);
  }
  /// Of a column, in run.json.
  std::string unit(const char* run, const char* table, const std::string& key) const {
    const auto summary = nlohmann::json::parse(testing::bytes_of(path(run) / "run.json"));
    for (const auto& column : summary.at("tables").at(table)) {
      if (column.at("key") == key) {
        return column.at("unit");
      }
    }
    return "no column";
  }

  testing::ScratchFolder folder;
};

TEST_F(Si, ForcesLoadsAndStressAreNewtonsWithADensity) {
  run_of("si", {kDensity});
  run_of("plain", {});
  const auto expect_scaled = [&](const char* file, const char* column, double factor) {
    const auto plain = table("plain", file).column_numbers(column);
    const auto real = table("si", file).column_numbers(column);
    ASSERT_EQ(real.size(), plain.size()) << file;
    for (std::size_t row = 0; row < real.size(); ++row) {
      EXPECT_NEAR(real[row], factor * plain[row], 1e-12 * std::abs(real[row])) << column;
    }
  };
  constexpr double kGrain = kSiteWeight * kMeanMass;
  expect_scaled("contacts-rest.csv", "normal_force", kGrain);
  expect_scaled("contacts-rest.csv", "shear_force", kGrain);
  expect_scaled("contacts-rest.csv", "x", 1);
  expect_scaled("loads-rest.csv", "normal_force", kGrain);
  expect_scaled("loads-rest.csv", "residual", 1);
  expect_scaled("walls-rest.csv", "force_y", kGrain);
  expect_scaled("forces-rest.csv", "high", kGrain);
  expect_scaled("stress-rest.csv", "yy", kGrain / 0.002);
  const auto down = table("si", "walls-rest.csv").column_numbers("force_y");
  EXPECT_NEAR(std::accumulate(down.begin(), down.end(), 0.0), -120 * kGrain, 1e-3 * 120 * kGrain);

  EXPECT_EQ(unit("si", "walls", "force_x"), "N");
  EXPECT_EQ(unit("si", "stress", "pressure"), "N/m");
  EXPECT_EQ(unit("plain", "walls", "force_x"), "grain weights");
}

TEST_F(Si, FlowsThroughProbesAndLinesAreKilogramsPerSecondToo) {
  run_of("si", {kDensity, "probes={middle: [0, 20, 60, 40]}", "output={series: {every: 10}}",
                "lines={across: {from: [0, 30], to: [60, 30], parts: 3}}"});
  const auto summary = nlohmann::json::parse(testing::bytes_of(path("si") / "run.json"));
  constexpr double kSiteMass = kSiteWeight / 10;  // kg
  const double per_step = kSiteMass / summary.at("units").at("time_step").get<double>();
  const auto expect_scaled = [&](const char* file, const char* column, const char* plain,
                                 double factor) {
    const auto real = table("si", file).column_numbers(column);
    const auto sites = table("si", file).column_numbers(plain);
    double most = 0;
    for (std::size_t row = 0; row < real.size(); ++row) {
      if (std::isfinite(sites[row])) {  // the first row of a probe has none
        EXPECT_NEAR(real[row], factor * sites[row], 1e-5 * std::abs(real[row])) << column;
        most = std::max(most, real[row]);
      }
    }
    EXPECT_GT(most, 0);
  };
  expect_scaled("probes.csv", "mass_flow", "flow", per_step);
  expect_scaled("lines-rest.csv", "mass_flux", "flux", per_step / 0.002);
  EXPECT_EQ(unit("si", "probes", "mass_flow"), "kg/s");
  EXPECT_EQ(unit("si", "lines", "mass_flux"), "kg/(s·m)");
}

TEST_F(Si, LegendsOfPicturesAreInNewtons) {
  run_of("si", {kDensity});
  run_of("plain", {});
  run_of("pressure", {kDensity, "output.frames.color_by=pressure"});
  const auto legend = [&](const char* name) {
    const fs::path frames = path(name) / "frames";
    return image::decode_png(testing::bytes_of(fs::directory_iterator(frames)->path()))
        .text.at("Legend");
  };
  EXPECT_THAT(legend("si"), HasSubstr("load (N)"));
  EXPECT_THAT(legend("si"), HasSubstr(" N\""));
  EXPECT_THAT(legend("plain"), HasSubstr("load (grain weights)"));
  EXPECT_THAT(legend("pressure"), HasSubstr("pressure (N/m)"));
}

// The walls of the hopper have slopes of 26/25; the normal force presses on them.
TEST_F(Si, ForceOnAStraightWallIsAcrossAndAlongIt) {
  run_of("si", {kDensity});
  const auto walls = table("si", "walls-rest.csv");
  const std::vector<std::string> names = *walls.find_column("wall");
  const auto value = [&](const char* wall, const char* column) {
    const auto row = std::find(names.begin(), names.end(), wall) - names.begin();
    return walls.column_numbers(column).at(static_cast<std::size_t>(row));
  };
  const double length = std::hypot(25, 26);
  for (const auto& [wall, to_middle] : {std::pair("left", 1.0), {"right", -1.0}}) {
    const double x = to_middle * value(wall, "force_x");
    const double y = value(wall, "force_y");
    EXPECT_NEAR(value(wall, "normal_force"), (-26 * x - 25 * y) / length, 1e-9) << wall;
    EXPECT_NEAR(value(wall, "shear_force"), (25 * x - 26 * y) / length, 1e-9) << wall;
    EXPECT_GT(value(wall, "normal_force"), 0) << wall;
  }
  EXPECT_DOUBLE_EQ(value("gate", "normal_force"), -value("gate", "force_y"));
  EXPECT_DOUBLE_EQ(value("gate", "shear_force"), value("gate", "force_x"));
  EXPECT_DOUBLE_EQ(value("box.left", "normal_force"), -value("box.left", "force_x"));
  EXPECT_TRUE(std::isnan(value("both", "normal_force"))) << "its parts are not parallel";
}

}  // namespace
}  // namespace clca::record::si_test
