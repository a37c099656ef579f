// Forces on walls and what leaves, in series.csv and in SI units.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>

#include "clca/record/quantity.hpp"
#include "clca/run/run.hpp"
#include "clca/store/table.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::record::series_forces_test {
namespace {

namespace fs = std::filesystem;

constexpr double kMuch = 1e9;
constexpr double kSites = 7;  // of a grain

// Without friction at walls, only what lies below grains carries them.
constexpr const char* kBin = R"(clca: 1
model: contact
seed: 5
box: {width: 40, height: 80}
species: {grain: {shape: {hexagon: 1}}}
contact: {wall_friction: 0}
walls:
  floor: {box: [0, 0, 40, 3]}
  piston: {box: [0, 60, 40, 63], motion: {direction: down, path: [[2000, 20]]}}
stages:
  - name: settle
    fill: {region: [0, 3, 40, 60], counts: {grain: 60}}
    until: {steps: 3000}
  - {name: press, move: [piston], until: {steps: 2000}}
measure: []
output: {series: {every: 100, forces: true}}
)";

// A grain on a plate falls on it, and lies there.
constexpr const char* kPlate = R"(clca: 1
model: contact
seed: 5
box: {width: 60, height: 60}
species: {grain: {shape: {hexagon: 1}}}
contact: {restitution: 0.5}
walls: {plate: {box: [10, 10, 50, 13]}}
stages:
  - name: rest
    fill: {region: [40, 20, 44, 24], counts: {grain: 1}}
    until: {steps: 600}
  - {name: turn, vessel: {tilt: {to: 0.01, rate: 0.001}}, until: {steps: 10}}
measure: []
output: {series: {every: 10, forces: true}}
)";

class SeriesForces : public ::testing::Test {
 protected:
  fs::path path(const char* name = "run") const { return folder.path() / name; }
  std::vector<double> column(const std::string& name, const char* run = "run") const {
    return store::read_table(path(run) / "series.csv").column_numbers(name);
  }
  void run_of(const char* text, const std::vector<scene::Override>& overrides = {},
              const char* name = "run") const {
    run::run(scene::parse(text, "scene.yaml", overrides), {.folder = path(name)});
  }
  /// Of a row, on all walls and sides.
  double sum(const std::string& key, std::size_t row) const {
    double result = 0;
    for (const char* body : {"floor", "piston", "box.floor", "box.top", "box.left", "box.right"}) {
      result += column(key + "." + body).at(row);
    }
    return result;
  }

  testing::ScratchFolder folder;
};

TEST_F(SeriesForces, TheFloorBearsTheWeightOfABedAtRest) {
  run_of(kBin, {"stages.1.until={steps: 1}"});
  EXPECT_TRUE(std::isnan(column("force_y.floor").front())) << "no step yet";
  EXPECT_NEAR(column("force_y.floor").back(), -60 * kSites, 0.001 * 60 * kSites);
  EXPECT_NEAR(column("force_x.floor").back(), 0, 0.01 * 60 * kSites);
  EXPECT_EQ(column("force_y.piston").back(), 0);
  EXPECT_EQ(column("force_y.box.floor").back(), 0);
  EXPECT_GT(column("force_x.box.right").back(), 0);
  EXPECT_LT(column("force_x.box.left").back(), 0);
}

// It moves by 9 spacings and stays. The floor bears what it presses with, and the weight.
TEST_F(SeriesForces, APistonIsPushedBackAsTheFloorIsPressed) {
  run_of(kBin, {"walls.piston={box: [0, 24, 40, 27], motion: {direction: down, path: "
                "[[800, 9]]}}",
                "stages.0.fill.region=[0, 3, 40, 24]", "stages.0.fill.counts={grain: 60}",
                "stages.1.until={steps: 2000}"});
  const std::size_t last = column("step").size() - 1;
  const double pressing = column("force_y.piston").at(last);
  EXPECT_GT(pressing, 0.2 * 60 * kSites);
  EXPECT_NEAR(sum("force_y", last), -60 * kSites, 0.001 * 60 * kSites);
  EXPECT_NEAR(sum("force_x", last), 0, 0.001 * 60 * kSites);
}

// A bounce takes one step, and rows are ten steps apart.
TEST_F(SeriesForces, AreMeansOverAllStepsSinceTheLastRow) {
  run_of(kPlate);
  run_of(kPlate, {"output.series.every=1"}, "each");
  const auto tens = column("force_y.plate");
  const auto ones = column("force_y.plate", "each");
  const auto torques = column("torque.plate");
  const auto each_torque = column("torque.plate", "each");
  ASSERT_EQ(ones.size(), 10 * (tens.size() - 1) + 1);
  double most = 0;
  for (std::size_t row = 1; row < tens.size(); ++row) {
    const auto mean = [&](const std::vector<double>& values) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(10 * row - 9);
      return std::accumulate(first, first + 10, 0.0) / 10;
    };
    EXPECT_NEAR(tens[row], mean(ones), 1e-9) << row;
    EXPECT_NEAR(torques[row], mean(each_torque), 1e-9) << row;
    most = std::max(most, -tens[row]);
  }
  EXPECT_GT(most, 2 * kSites);
}

TEST_F(SeriesForces, TheTorqueOfAGrainIsItsWeightTimesTheLever) {
  run_of(kPlate, {"output.trajectory={every: 600}"});
  const auto stage = store::read_table(path() / "series.csv");
  const auto heights = column("mean_height");
  const auto force = column("force_y.plate");
  const auto torque = column("torque.plate");
  const auto rest = static_cast<std::size_t>(
      std::find(stage.find_column("stage")->begin(), stage.find_column("stage")->end(), "turn") -
      stage.find_column("stage")->begin() - 1);
  EXPECT_NEAR(force[rest], -kSites, 1e-3 * kSites);
  // Where the grain lies: from 39 to 45 in the fill.
  const double lever = torque[rest] / force[rest];
  const double middle_of_plate = 34.5 * lattice::kColumnPitch;  // columns 12 to 57
  EXPECT_GT(middle_of_plate + lever, 39);
  EXPECT_LT(middle_of_plate + lever, 45);
  // Columns are steps of the lever, which is exact.
  const double column_of_grain = (middle_of_plate + lever) / lattice::kColumnPitch;
  EXPECT_NEAR(column_of_grain, std::round(column_of_grain), 1e-6);
  // While the vessel turns: about the middle of the box, 30 from the left.
  const double x_force = column("force_x.plate").back();
  const double arm = middle_of_plate + lever - 30;
  const double height = heights.back() - std::sqrt(kSites * lattice::kColumnPitch / std::acos(-1));
  EXPECT_NEAR(torque.back(), arm * force.back() - (height - 30) * x_force, 1e-3 * kSites);
}

TEST_F(SeriesForces, OfARunThatWasStoppedAreTheSameBytes) {
  const scene::Scene scene =
      scene::parse(kBin, "scene.yaml",
                   {"units={spacing: 1 mm, density: 2}", "outlets={drain: {region: [0, 3, 20, 9]}}",
                    "stages.0.until={steps: 500}", "stages.1.until={steps: 200}"});
  run::run(scene, {.folder = path("unbroken"), .threads = 3, .parallel_from = 1});
  std::atomic<int> stop = 0;
  std::uint64_t until = 0;
  const run::RunEvents events = {
      .progress = [&](const run::Progress& at) { stop = at.step >= until ? 15 : 0; },
      .progress_interval = {}};
  run::run(scene, {.folder = path(), .stop_signal = &stop}, events);
  for (const std::uint64_t next : {100U, 101U, 333U, 500U, 501U, 657U}) {
    until = next;
    stop = 0;
    run::resume(run::load_run(path(), kMuch),
                {.use_reference_step = next == 333U, .stop_signal = &stop}, events);
  }
  EXPECT_EQ(run::resume(run::load_run(path(), kMuch), {}).status, "done");
  EXPECT_EQ(testing::bytes_of(path() / "series.csv"),
            testing::bytes_of(path("unbroken") / "series.csv"));
  EXPECT_EQ(testing::difference_of_runs(path("unbroken"), path()), "");
}

// A site has √3/2 mm² and 2 kg/m²: 1.7321e-6 kg.
TEST_F(SeriesForces, AreNewtonsWithADensity) {
  // The rate of turning would be one in seconds.
  const std::string rest = "stages.1={name: wait, until: {steps: 10}}";
  run_of(kPlate, {rest, "units={spacing: 1 mm, gravity: 9.81, density: 2}"});
  run_of(kPlate, {rest}, "plain");
  constexpr double kWeight = 1.7320508075688772e-6 * 9.81;
  const auto expect_scaled = [&](const char* name, double factor) {
    const auto plain = column(name, "plain");
    const auto real = column(name);
    ASSERT_EQ(real.size(), plain.size());
    for (std::size_t row = 1; row < real.size(); ++row) {
      EXPECT_NEAR(real[row], factor * plain[row], 1e-12 * std::abs(real[row])) << name;
    }
  };
  expect_scaled("force_y.plate", kWeight);
  expect_scaled("torque.plate", kWeight * 1e-3);
  expect_scaled("kinetic_energy", kWeight * 1e-3);
  expect_scaled("mean_height", 1);
  EXPECT_NEAR(column("force_y.plate").at(60), -1.1894e-4, 1e-7);  // 7 sites
  const KnownQuantities known = known_quantities(store::read_summary(path() / "run.json"));
  EXPECT_EQ(known.find("force_y.plate")->name, "Force on the wall, y");
  EXPECT_EQ(known.find("force_y.plate")->part, "plate");
  EXPECT_EQ(known.find("force_y.plate")->unit, "N");
  EXPECT_EQ(known.find("torque.box.floor")->part, "box.floor");
  EXPECT_EQ(known.find("torque.box.floor")->unit, "N m");
  EXPECT_EQ(known.find("kinetic_energy")->unit, "J");
  EXPECT_EQ(
      known_quantities(store::read_summary(path("plain") / "run.json")).find("force_y.plate")->unit,
      "weights of a site");
}

TEST_F(SeriesForces, WhatLeavesIsCountedInKilogramsAndParticlesASecond) {
  const auto summary = run::run(
      scene::parse(
          kBin, "scene.yaml",
          {"measure=[outflow]", "walls={}", "stages.1={name: wait, until: {steps: 10}}",
           "outlets={drain: {region: [0, 0, 40, 10]}}", "units={spacing: 1 mm, density: 2}"}),
      {.folder = path()});
  constexpr double kGrain = kSites * 1.7320508075688772e-6;  // kg
  const auto time = column("time");
  const auto mass = column("mass_flow_rate");
  const auto particles = column("particle_flow_rate");
  double left = 0;
  double kilograms = 0;
  for (std::size_t row = 1; row < time.size(); ++row) {
    left += particles[row] * (time[row] - time[row - 1]);
    kilograms += mass[row] * (time[row] - time[row - 1]);
  }
  EXPECT_EQ(column("discharged_particles").back(), 60);
  const double flown = 60 - column("discharged_particles").front();  // the fill lay in the drain
  EXPECT_LT(flown, 60);
  EXPECT_NEAR(left, flown, 1e-9);
  EXPECT_NEAR(kilograms, flown * kGrain, 1e-12);
  const auto measure = [&](const char* name) {
    return testing::measure_of(summary, "settle", name);
  };
  EXPECT_GT(measure("outflow_sites_per_time"), 0);
  EXPECT_NEAR(measure("outflow_particles_per_time"), measure("outflow_sites_per_time") / kSites,
              1e-9);
  EXPECT_NEAR(measure("outflow_mass_per_time"), measure("outflow_particles_per_time") * kGrain,
              1e-15);
}

TEST_F(SeriesForces, AreOnlyThereWhereTheSceneWantsThem) {
  run_of(kPlate, {"output.series.forces=false", "outlets={drain: {region: [0, 0, 60, 10]}}"});
  const auto names = store::read_table(path() / "series.csv").column_names;
  EXPECT_THAT(names, ::testing::Not(::testing::Contains("force_x.plate")));
  EXPECT_THAT(names, ::testing::Not(::testing::Contains("mass_flow_rate")));
  EXPECT_FALSE(store::read_summary(path() / "run.json").units->site_mass);
}

}  // namespace
}  // namespace clca::record::series_forces_test
