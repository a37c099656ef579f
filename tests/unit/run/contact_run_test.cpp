// Runs of the contact model: what they leave, and that they go on as if they had never been
// stopped.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>

#include "clca/image/png.hpp"
#include "clca/run/run.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/file.hpp"
#include "clca/store/table.hpp"
#include "record/energy_record.hpp"
#include "run/stage.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::run::contact_run_test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr double kMuch = 1e9;

constexpr const char* kSmall = R"(clca: 1
model: contact
seed: 3
box: {width: 40, height: 60}
species: {grain: {shape: {hexagon: 1}}}
walls: {gate: {box: [20, 0, 21, 60], friction: 0.1}}
sources: {spout: {region: [4, 50, 12, 54], species: {grain: 1}, rate: 0.05, count: 4}}
outlets: {drain: {region: [22, 0, 41, 8]}}
probes: {gap: [20, 0, 40, 30]}
lines: {gate: {from: [20, 0], to: [20, 30], parts: 6}, brink: {from: [0, 8.2], to: [40, 8.2]}}
stages:
  - name: packing
    fill: {region: [0, 0, 20, 60], counts: {grain: 40}}
    until: {steps: 300}
  - name: flow
    remove: [gate]
    sources: [spout]
    until: {steps: 300}
measure: [profile, packing, moved, outflow, force]
output:
  frames: {every: 100, width: 96, height: 64, color_by: force, overlay: forces}
  series: {every: 1}
  trajectory: {every: 10}
  checkpoint: {every: 50}
)";

class ContactRunTest : public ::testing::Test {
 protected:
  static scene::Scene small(const std::vector<scene::Override>& overrides = {}) {
    return scene::parse(kSmall, "small.yaml", overrides);
  }
  fs::path path(const char* name = "run") const { return folder.path() / name; }

  testing::ScratchFolder folder;
};

TEST_F(ContactRunTest, ItsSidesAndWallsOfTheSameNameAreToldApart) {
  run(scene::parse(R"(clca: 1
model: contact
seed: 3
box: {width: 40, height: 60}
species: {grain: {shape: {hexagon: 1}}}
walls:
  left: {box: [-1, 0, 1, 60]}
  right: {box: [20, 0, 21, 60]}
  floor: {box: [1, 0, 20, 2]}
  top: {box: [1, 50, 20, 51]}
  ceiling: {box: [21, 50, 39, 51]}
stages:
  - name: rest
    fill: {region: [0, 2, 40, 50], counts: {grain: 80}}
    until: {steps: 400}
)",
                   "sides.yaml"),
      {.folder = path()});
  const store::ReadTable walls = store::read_table(path() / "walls-rest.csv");
  EXPECT_THAT(*walls.find("wall"),
              ::testing::UnorderedElementsAre("left", "right", "floor", "top", "ceiling",
                                              "box.left", "box.right", "box.floor", "box.top"));
  const store::ReadTable contacts = store::read_table(path() / "contacts-rest.csv");
  std::map<std::string, double> sums;  // of what carries weight
  for (std::size_t row = 0; row < contacts.rows(); ++row) {
    const std::string& second = (*contacts.find("second"))[row];
    sums[second] += contacts.numbers("normal_force")[row] * contacts.numbers("normal_y")[row] +
                    contacts.numbers("shear_force")[row] * contacts.numbers("normal_x")[row];
  }
  for (std::size_t row = 0; row < walls.rows(); ++row) {
    const std::string& wall = (*walls.find("wall"))[row];
    EXPECT_NEAR(-walls.numbers("force_y")[row], sums[wall], 1e-9) << wall;
  }
  EXPECT_GT(sums["floor"], 1);
  EXPECT_GT(sums["box.floor"], 1);
}

// Shapes that lock into one another: none gets faster where it is. Once by 62 %.
TEST_F(ContactRunTest, ABedOfShapesThatInterlockGainsNoEnergy) {
  for (const int seed : {1, 2, 3}) {
    const store::RunSummary summary =
        run(scene::parse(R"(clca: 1
model: contact
box: {width: 80.4, height: 97, periodic: true}
species:
  a: {shape: {sites: [[0, 0], [1, 0], [2, -1], [-1, 1], [1, -1], [1, -2], [1, 1]]}}
  b:
    shape: {sites: [[0, 0], [1, -1], [1, -2], [-1, 0], [-1, 1], [1, -3], [0, 1], [2, -4], [-2, 0]]}
    orientations: any
contact: {rolling: none, fall_height: 42.5}
walls: {w0: {disc: {centre: [30.1, 26.4], radius: 2.5}}}
stages:
  - name: bed
    fill: {region: [0, 0, 80.4, 68], mix: {a: 1, b: 1}, method: deposition, level: 15}
    until: settled
    max_steps: 6000
)",
                         "locked.yaml", {fmt::format("seed={}", seed)}),
            {.folder = path(), .overwrite = true});
    EXPECT_LT(testing::measure_of(summary, "bed", "energy_growth"), 0.002) << seed;
    EXPECT_EQ(summary.stages.front().ended, "settled") << seed;
  }
}

// The grain touches a side all the time, so that it rests where it turns.
TEST_F(ContactRunTest, RestLiftsNoGrain) {
  std::string warnings;
  const RunEvents events = {.warning = [&](const std::string& line) { warnings += line; }};
  const store::RunSummary summary = run(scene::parse(R"(clca: 1
model: contact
seed: 7
box: {width: 2.7, height: 6}
species: {grain: {shape: {hexagon: 1}}}
contact: {rolling: resistance, friction: 1, restitution: 0.9, resolution: 0.2}
stages: [{name: fall, fill: {region: [0, 0, 2.7, 6], counts: {grain: 1}}, until: {steps: 3000}}]
)",
                                                     "narrow.yaml"),
                                        {.folder = path()}, events);
  EXPECT_LT(testing::measure_of(summary, "fall", "energy_growth"), 0.002);
  EXPECT_EQ(warnings, "");
}

TEST_F(ContactRunTest, RunJsonHasTheSidesOfItsBox) {
  run(small({"box.periodic=true"}), {.folder = path()});
  const auto box = store::read_summary(path() / "run.json").box;
  ASSERT_TRUE(box);
  EXPECT_EQ(box->left, -lattice::kColumnPitch / 2);
  EXPECT_DOUBLE_EQ(box->right, 47.5 * lattice::kColumnPitch);  // 48 columns
  EXPECT_EQ(box->floor, -0.5);
  EXPECT_EQ(box->top, 60);
  EXPECT_TRUE(box->periodic);
}

TEST_F(ContactRunTest, TheSeriesHasItsEnergies) {
  run(small(), {.folder = path()});
  const auto kinetic = testing::csv_column(path() / "series.csv", "kinetic_energy");
  const auto potential = testing::csv_column(path() / "series.csv", "potential_energy");
  const auto discharged = testing::csv_column(path() / "series.csv", "discharged_particles");
  ASSERT_EQ(kinetic.size(), 601U);
  EXPECT_EQ(kinetic.front(), 0);
  EXPECT_GT(potential.front(), 40 * 7 * 10);
  EXPECT_GT(*std::max_element(kinetic.begin(), kinetic.end()), 0);
  // While nothing enters, what falls only gains what it loses, but for what rest forgets.
  for (std::size_t step = 0; step <= 300; ++step) {
    EXPECT_LE(kinetic[step] + potential[step], 1.005 * potential.front());
  }
  EXPECT_GT(discharged.back(), 0);
}

TEST_F(ContactRunTest, ItsSummaryAndCheckpointsAreOfItsKind) {
  EXPECT_EQ(run(small(), {.folder = path()}).kind, "contact");
  EXPECT_EQ(store::read_checkpoint(path(), kMuch)->checkpoint.kind, "contact");
}

TEST_F(ContactRunTest, ATiltedVesselHasItsAngleAndSlopesAgainstGravity) {
  const auto summary = run(scene::parse(R"(clca: 1
model: contact
seed: 5
box: {width: 240, height: 60}
species: {grain: {shape: {hexagon: 1}}}
stages:
  - name: packing
    fill: {region: [0, 0, 240, 60], counts: {grain: 600}}
    until: {steps: 1500}
  - {name: tilt, vessel: {tilt: 30}, until: {steps: 10}}
measure: [repose]
output: {series: {every: 10}}
)",
                                        "tilted.yaml"),
                           {.folder = path()});
  const auto angles = testing::csv_column(path() / "series.csv", "vessel_angle_deg");
  EXPECT_EQ(angles.front(), 0);
  EXPECT_NEAR(angles.back(), 30, 1e-9);
  EXPECT_EQ(testing::measure_of(summary, "packing", "vessel_angle_deg"), 0);
  EXPECT_NEAR(testing::measure_of(summary, "tilt", "vessel_angle_deg"), 30, 1e-9);
  // Level with the floor still.
  EXPECT_NEAR(testing::measure_of(summary, "tilt", "repose_gravity_left_deg"), 30, 2);
}

TEST_F(ContactRunTest, WhatIsDissipatedClosesTheBalance) {
  run(small(), {.folder = path()});
  const auto column = [&](const char* name) {
    return testing::csv_column(path() / "series.csv", name);
  };
  const auto kinetic = column("kinetic_energy");
  const auto potential = column("potential_energy");
  const auto dissipated = column("dissipated_energy");
  // Nothing comes or goes in the first stage; what has begun the second one has no row.
  for (std::size_t step = 0; step < 300; ++step) {
    EXPECT_DOUBLE_EQ(dissipated[step], potential[0] - kinetic[step] - potential[step]);
  }
  EXPECT_GT(dissipated[299], 0.1 * potential[0]);
  // Four grains of 7 sites come in from above, and many leave: neither is dissipated.
  const auto discharged = column("discharged_sites");
  ASSERT_GT(discharged.back(), 0);
  EXPECT_GT(dissipated.back(), 0);
  EXPECT_GT(potential[300] + 4 * 7 * 54 - potential.back(), dissipated.back());
  EXPECT_LT(potential[300] - potential.back(), dissipated.back() + 4 * 7 * 54);
}

constexpr const char* kBed = R"(clca: 1
model: contact
seed: 5
box: {width: 40, height: 120}
species: {small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}
contact: {wall_friction: 0}
stages:
  - name: settle
    fill: {region: [0, 0, 40, 120], counts: {small: 60, large: 60}}
    until: {steps: 4000}
measure: [force]
output: {fields: {cell: 8, every: 1000}, contacts: {window: 100}}
)";

// Side walls without friction carry nothing.
TEST_F(ContactRunTest, StressGrowsWithDepthAsTheWeightAbove) {
  run(scene::parse(kBed, "bed.yaml"), {.folder = path()});
  const auto column = [&](const char* table, const char* name) {
    return testing::csv_column(path() / (std::string(table) + "-settle.csv"), name);
  };
  const auto heights = column("stress", "y");
  const auto yy = column("stress", "yy");
  const double width = 47 * lattice::kColumnPitch;
  const double mean_sites = (7.0 + 19.0) / 2;
  const auto ids = column("loads", "id");
  const auto grain_heights = column("loads", "y");
  std::map<double, double> carried;  // by height of a row of cells
  for (std::size_t i = 0; i < heights.size(); ++i) {
    carried[heights[i]] += yy[i];
  }
  ASSERT_GE(carried.size(), 4U);
  const double cells_across = 5;
  const double cell_height = 120.5 / 15;
  double before = 1e9;
  for (const auto& [height, sum] : carried) {
    double above = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const double share = std::clamp((grain_heights[i] - height) / cell_height + 0.5, 0.0, 1.0);
      above += share * (ids[i] < 60 ? 7 : 19) / mean_sites;
    }
    const double stress = sum / cells_across;
    EXPECT_LT(stress, before);
    before = stress;
    // Within 2 % of the weight of the bed; in the lowest cells, of which up to a spacing lies below
    // where grains touch the floor, 8 %.
    const double tolerance = height < cell_height ? 0.08 : 0.02;
    EXPECT_NEAR(stress * width, above, tolerance * 120) << "at height " << height;
  }
  const auto loads = column("walls", "force_y");
  EXPECT_NEAR(-loads.at(0), 120, 1.2);
}

// The floor bears some of the weight; each pressure is over its own mean.
TEST_F(ContactRunTest, PathsOfWeightStandBesideItsForcesOnTheBase) {
  const auto scene =
      small({"measure=[weight_paths]", "stages.0.until={steps: 2000}", "output.frames=none"});
  const auto result = run(scene, {.folder = path()});
  const fs::path table = path() / "weight_paths-packing.csv";
  for (const char* rule : {"inner", "outer", "pair", "q", "contact"}) {
    const auto pressure = testing::csv_column(table, std::string("pressure_") + rule);
    ASSERT_EQ(pressure.size(), 13) << rule;
    EXPECT_NEAR(std::accumulate(pressure.begin(), pressure.end(), 0.0), 13, 1e-9) << rule;
  }
  EXPECT_EQ(testing::csv_column(table, "base_position").at(6), 0);
  const auto inner = testing::csv_column(table, "pressure_inner");
  const auto forces = testing::csv_column(table, "pressure_contact");
  double squares = 0;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    squares += (inner[i] - forces[i]) * (inner[i] - forces[i]);
  }
  const auto& measures = result.stages.front().measures;
  const auto found =
      std::ranges::find(measures, "base_deviation_inner", &store::NamedMeasure::first);
  ASSERT_NE(found, measures.end());
  EXPECT_NEAR(std::get<double>(found->second), std::sqrt(squares / 13), 1e-9);
}

TEST_F(ContactRunTest, AWindowAveragesTheForcesOfItsSteps) {
  // The means of windows of one step, over the last three ends of the stage.
  double sum = 0;
  for (const int steps : {198, 199, 200}) {
    const std::string name = std::to_string(steps);
    run(small({"stages.0.until={steps: " + name + "}", "measure=[force]",
               "output.contacts={window: 1}"}),
        {.folder = path(name.c_str())});
    sum += testing::csv_column(path(name.c_str()) / "walls-packing.csv", "force_y").at(0);
  }
  run(small({"stages.0.until={steps: 200}", "measure=[force]", "output.contacts={window: 3}"}),
      {.folder = path()});
  EXPECT_NEAR(testing::csv_column(path() / "walls-packing.csv", "force_y").at(0), sum / 3,
              1e-3 * -sum / 3);
}

// What the balance misses looks like energy from nowhere.
// Gains stand for energy that the balance misses.
// A grain that has just landed still has the impulse of its impact.
TEST_F(ContactRunTest, ForcesSinceTheBedCameToRestAreWithoutItsLastImpact) {
  const store::RunSummary summary = run(scene::parse(R"(clca: 1
model: contact
seed: 1
box: {width: 30, height: 60}
species: {grain: {shape: {hexagon: 1}}}
contact: {restitution: 0, fall_height: 40}
stages: [{name: rest, fill: {region: [0, 0, 30, 60], counts: {grain: 1}}}]
measure: [force]
)",
                                                     "landed.yaml"),
                                        {.folder = path()});
  EXPECT_NEAR(testing::measure_of(summary, "rest", "load_floor"), 1, 1e-3);
  const store::ReadTable walls = store::read_table(path() / "walls-rest.csv");
  for (std::size_t row = 0; row < walls.rows(); ++row) {
    if ((*walls.find("wall"))[row] == "floor") {
      EXPECT_NEAR(walls.numbers("force_y")[row], -1, 1e-3);
    }
  }
}

TEST_F(ContactRunTest, AStageUntilSettledTakesSixtyStepsAtLeastHoweverCoarseTheyAre) {
  for (const int seed : {1, 2, 3, 4}) {
    const store::RunSummary summary =
        run(scene::parse(R"(clca: 1
model: contact
box: {width: 40, height: 60}
species: {grain: {shape: {hexagon: 1}}}
contact: {resolution: 1, fall_height: 2, rolling: free, restitution: 0.9}
stages:
  - {name: fall, fill: {region: [0, 0, 40, 60], counts: {grain: 60}}, max_steps: 3000}
  - {name: rest, max_steps: 3000}
)",
                         "coarse.yaml", {"seed=" + std::to_string(seed)}),
            {.folder = path(), .overwrite = true});
    EXPECT_GE(summary.stages[1].steps, 60U) << seed;
  }
}

// By default a grain moves a site a step at most where it falls freely. Where it is made to fall
// faster than it can move, it loses velocity and energy, and a line says so.
TEST_F(ContactRunTest, AGrainThatFallsFarGainsNoEnergy) {
  constexpr const char* kTall = R"(clca: 1
model: contact
box: {width: 20, height: 1000}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: fall, fill: {region: [0, 980, 20, 1000], counts: {grain: 1}}, until: {steps: 900}}]
output: {series: {every: 1}}
)";
  for (const bool is_default : {true, false}) {
    std::string warnings;
    const RunEvents events = {.warning = [&](const std::string& line) { warnings += line; }};
    const std::vector<scene::Override> overrides =
        is_default ? std::vector<scene::Override>()
                   : std::vector<scene::Override>{"contact.fall_height=10"};
    run(scene::parse(kTall, "tall.yaml", overrides), {.folder = path(), .overwrite = true}, events);
    const store::ReadTable series = store::read_table(path() / "series.csv");
    const double whole =
        series.numbers("kinetic_energy")[0] + series.numbers("potential_energy")[0];
    const std::vector<double> dissipated = series.numbers("dissipated_energy");
    EXPECT_GT(*std::min_element(dissipated.begin(), dissipated.end()), -0.002 * whole);
    if (is_default) {
      EXPECT_EQ(warnings, "");
    } else {
      EXPECT_THAT(warnings, HasSubstr("a grain falls faster than it can move, and loses velocity"));
    }
  }
}

TEST_F(ContactRunTest, EnergyThatFallsWithoutEndIsMeasuredByItsFall) {
  const auto scene = small();
  model::SceneModel model(scene, first_state(scene), {});
  prepare_stage(model, scene, 0);
  record::EnergyRecord record(scene);
  record.begin(scene.stages.front(), model);
  const auto energy = model.contact()->energy();
  const double start = energy.kinetic + energy.potential;
  EXPECT_FALSE(record.add(model, {.sources = 100 * start}));
  EXPECT_EQ(record.growth().value(), 0);
  EXPECT_FALSE(record.add(model, {.outlets = 0.3 * start}));
  EXPECT_NEAR(record.growth().value(), 0.003, 1e-12);
}

TEST_F(ContactRunTest, EnergyThatGrowsIsToldOnce) {
  const auto scene = small();
  model::SceneModel model(scene, first_state(scene), {});
  prepare_stage(model, scene, 0);
  record::EnergyRecord record(scene);
  record.begin(scene.stages.front(), model);
  const auto energy = model.contact()->energy();
  const double start = energy.kinetic + energy.potential;
  EXPECT_FALSE(record.add(model, {.outlets = 0.008 * start}));
  const auto growth = record.add(model, {.outlets = 0.004 * start});
  ASSERT_TRUE(growth);
  EXPECT_DOUBLE_EQ(growth->scale, start);
  EXPECT_DOUBLE_EQ(growth->now, 1.012 * start);
  EXPECT_NEAR(record.growth().value(), 0.012, 1e-12);
  EXPECT_FALSE(record.add(model, {.outlets = start}));
  record.begin(scene.stages.back(), model);  // with a source
  EXPECT_FALSE(record.growth());
}

TEST_F(ContactRunTest, TheSeriesOfAnAutomatonHasNone) {
  run(small({"model=automaton", "walls.gate={box: [20, 0, 21, 60]}",
             "output.frames.color_by=species", "output.frames.overlay=none"}),
      {.folder = path()});
  EXPECT_THROW(testing::csv_column(path() / "series.csv", "kinetic_energy"), std::out_of_range);
}

TEST_F(ContactRunTest, TheReferenceEngineLeavesTheSameRun) {
  const auto fast = run(small(), {.folder = path("fast"), .threads = 2});
  const auto reference = run(small(), {.folder = path("reference"), .reference = true});
  EXPECT_EQ(reference.state_hash, fast.state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("fast"), path("reference")), "");
}

TEST_F(ContactRunTest, TheReferenceEngineOfTheAutomatonLeavesTheSameRun) {
  const auto scene = small({"model=automaton", "walls.gate={box: [20, 0, 21, 60]}",
                            "output.frames.color_by=species", "output.frames.overlay=none"});
  const auto fast = run(scene, {.folder = path("fast"), .threads = 2});
  const auto reference = run(scene, {.folder = path("reference"), .reference = true});
  EXPECT_EQ(reference.state_hash, fast.state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("fast"), path("reference")), "");
}

TEST_F(ContactRunTest, StoppedTimeAndAgainARunIsTheSameAsInOneGo) {
  const auto expected = run(small(), {.folder = path("unbroken")});
  std::atomic<int> stop = 0;
  std::uint64_t until = 0;
  const RunEvents events = {
      .progress = [&](const Progress& at) { stop = at.step >= until ? 15 : 0; },
      .progress_interval = {}};
  run(small(), {.folder = path(), .stop = &stop}, events);
  for (const std::uint64_t next : {7U, 133U, 257U, 300U, 301U, 444U}) {
    until = next;
    stop = 0;
    EXPECT_EQ(
        resume(load_run(path(), kMuch), {.reference = next == 133U, .stop = &stop}, events).status,
        "interrupted");
  }
  EXPECT_EQ(resume(load_run(path(), kMuch), {.time_limit = 0.0}).status, "interrupted");
  EXPECT_EQ(resume(load_run(path(), kMuch), {}).state_hash, expected.state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("unbroken"), path()), "");
}

TEST_F(ContactRunTest, UnitsChangeNoStateAndScaleTimesAndVelocities) {
  const std::vector<scene::Override> fields = {
      "output.fields={cell: 10, every: 100}",
      "lines={gate: {from: [20, 0], to: [20, 10], parts: 1}}"};
  auto with_units = fields;
  with_units.emplace_back("units={spacing: 2 mm, gravity: 5}");
  const auto plain = run(small(fields), {.folder = path("plain")});
  const auto real = run(small(with_units), {.folder = path("real")});
  EXPECT_EQ(real.state_hash, plain.state_hash);
  const double second = std::sqrt(0.002 / 5);  // for one √(spacing/gravity)
  const double speed = std::sqrt(0.002 * 5);   // for one √(spacing·gravity)
  const auto expect_scaled = [&](const char* table, const char* column, double factor) {
    const auto before = testing::csv_column(path("plain") / table, column);
    const auto after = testing::csv_column(path("real") / table, column);
    ASSERT_EQ(after.size(), before.size());
    EXPECT_GT(*std::max_element(before.begin(), before.end()), 0) << column;
    for (std::size_t row = 0; row < before.size(); ++row) {
      EXPECT_NEAR(after[row], factor * before[row], 1e-12 * std::abs(after[row])) << column;
    }
  };
  expect_scaled("series.csv", "step", 1);
  expect_scaled("series.csv", "time", second);
  expect_scaled("series.csv", "mean_height", 1);
  expect_scaled("series.csv", "kinetic_energy", 1);
  expect_scaled("fields.csv", "step", 1);
  expect_scaled("fields.csv", "time", second);
  expect_scaled("fields.csv", "vx", speed);
  expect_scaled("fields.csv", "fluctuation", speed * speed);
  expect_scaled("lines-flow.csv", "flux", 1);
  expect_scaled("lines-flow.csv", "v_across", speed);
  expect_scaled("lines-flow.csv", "v_along_se", speed);
  const auto measure = [](const store::RunSummary& summary, const char* name) {
    return testing::measure_of(summary, "flow", name);
  };
  EXPECT_EQ(measure(real, "outflow_sites_per_step"), measure(plain, "outflow_sites_per_step"));
  EXPECT_GT(measure(plain, "outflow_sites_per_time"), 0);
  EXPECT_NEAR(measure(real, "outflow_sites_per_time"),
              measure(plain, "outflow_sites_per_time") / second, 1e-9);
  EXPECT_NEAR(measure(plain, "outflow_sites_per_time"),
              measure(plain, "outflow_sites_per_step") / plain.units->time_step, 1e-12);
  EXPECT_NEAR(measure(real, "fluctuation_energy"),
              measure(plain, "fluctuation_energy") * speed * speed, 1e-12);
}

// s = g t²/2; the tolerance of a step is what rounding up and the two steps at rest cost.
TEST_F(ContactRunTest, AGrainFallsFreelyForTheSecondsOfNewton) {
  const scene::Scene fall = scene::parse(R"(clca: 1
model: contact
box: {width: 20, height: 420}
species: {grain: {shape: {hexagon: 1}}}
contact: {fall_height: 400}
units: {spacing: 1 cm}
stages:
  - name: fall
    fill: {region: [8, 408, 12, 414], counts: {grain: 1}}
    until: {time: 0.9}
output: {series: {}, fields: {cell: 1000, every: 50}}
)",
                                         "fall.yaml");
  const auto summary = run(fall, {.folder = path()});
  constexpr double kGravity = 9.81;
  const double time_step = summary.units->time_step;
  const auto time = testing::csv_column(path() / "series.csv", "time");
  const auto potential = testing::csv_column(path() / "series.csv", "potential_energy");
  const auto kinetic = testing::csv_column(path() / "series.csv", "kinetic_energy");
  EXPECT_NEAR(time.back(), 0.9, time_step);
  constexpr double kSites = 7;
  const auto fallen = [&](std::size_t row) {  // metres
    return (potential.front() - potential[row]) / kSites * 0.01;
  };
  for (const double height : {0.1, 0.5, 1.0, 2.0, 3.5}) {
    std::size_t row = 0;
    while (fallen(row) < height) {
      ASSERT_LT(++row, time.size());
    }
    EXPECT_NEAR(time[row], std::sqrt(2 * height / kGravity), 1.5 * time_step) << height;
    EXPECT_NEAR(kinetic[row], potential.front() - potential[row], 0.05 * kinetic[row]) << height;
  }
  const auto end = testing::csv_column(path() / "fields.csv", "time");
  const auto velocity = testing::csv_column(path() / "fields.csv", "vy");
  ASSERT_GT(end.size(), 3U);
  for (std::size_t window = 0; window + 1 < end.size(); ++window) {  // the last one is shorter
    const double middle = end[window] - 25 * time_step;
    EXPECT_NEAR(velocity[window], -kGravity * middle, 0.01 / (50 * time_step)) << window;
  }
}

TEST_F(ContactRunTest, AStageUntilATimeTakesItsStepsAndGoesOnToALaterOne) {
  const auto timed = [&](const std::string& time) {
    return small({"units={spacing: 1 mm}", "stages.flow.until={time: " + time + "}"});
  };
  const auto first = run(timed("0.1"), {.folder = path()});
  EXPECT_EQ(first.stages[1].ended, "time");
  EXPECT_EQ(first.stages[1].steps, *scene::steps_of(timed("0.1").stages[1].until));
  EXPECT_THAT([&] { resume(load_run(path(), kMuch, "{time: 0.05}"), {}); },
              ::testing::ThrowsMessage<scene::SceneError>(HasSubstr("has passed this end")));
  const auto later = resume(load_run(path(), kMuch, "{time: 0.2}"), {});
  EXPECT_EQ(later.state_hash, run(timed("0.2"), {.folder = path("at once")}).state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("at once"), path()), "");
}

TEST_F(ContactRunTest, PicturesAndProgressSayTheTime) {
  std::string last;
  const RunEvents events = {.progress = [&](const Progress& at) { last = at.time; },
                            .progress_interval = {}};
  const auto summary = run(small({"units={spacing: 1 mm}"}), {.folder = path()}, events);
  EXPECT_EQ(last, summary.units->time_text(600));
  EXPECT_THAT(last, EndsWith(" s"));
  const auto text = image::decode_png(testing::bytes_of(path() / "frames/small-000600.png")).text;
  EXPECT_EQ(text.at("Time"), last);
  EXPECT_EQ(text.at("Step"), "600");
}

// Contents that no run has saved, under a right checksum.
TEST_F(ContactRunTest, AHostileCheckpointIsRefused) {
  std::atomic<int> stop = 0;
  run(small(), {.folder = path(), .stop = &stop},
      {.progress = [&](const Progress& at) { stop = at.step >= 400 ? 2 : 0; },
       .progress_interval = {}});
  const auto original = store::read_checkpoint(path(), kMuch)->checkpoint;
  const auto refusal = [&](const auto& damage) {
    auto checkpoint = original;
    damage(checkpoint);
    store::write_checkpoint(store::OutputFolder(path()), checkpoint);
    store::write_checkpoint(store::OutputFolder(path()), checkpoint);
    const std::atomic<int> at_once = 2;
    try {
      resume(load_run(path(), kMuch), {.stop = &at_once});
    } catch (const store::StoreError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto column = [](const std::string& name, auto value) {
    return [=](store::Checkpoint& checkpoint) {
      std::get<std::vector<decltype(value)>>(checkpoint.fields.at(name)).at(0) = value;
    };
  };
  constexpr std::int32_t kGreatest = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(refusal([](store::Checkpoint&) {}), "");
  EXPECT_THAT(refusal([](store::Checkpoint& one) { one.fields.erase("state/velocities/spin"); }),
              EndsWith("state/velocities/spin is missing"));
  EXPECT_THAT(refusal(column("state/velocities/x", kGreatest)),
              EndsWith("a velocity is out of range"));
  EXPECT_THAT(refusal(column("state/remainders/y", -kGreatest)),
              EndsWith("a remainder is out of range"));
  EXPECT_THAT(refusal(column("state/contacts/impulse/normal", std::int32_t{-1})),
              EndsWith("an impulse is out of range"));
  EXPECT_THAT(refusal(column("state/contacts/upper", std::uint32_t{1000})),
              EndsWith("a contact is not one of two bodies"));
  EXPECT_THAT(refusal(column("state/contacts/other", std::int32_t{-1})),
              EndsWith("a contact is not one of two bodies"));
  EXPECT_THAT(refusal(column("state/contacts/size", std::uint64_t{1} << 40U)),
              EndsWith("state/contacts needs more memory than the limit"));
  EXPECT_THAT(
      refusal(column("records/contacts/pictures/window/block/sums/upper", std::uint32_t{1000})),
      EndsWith("records/contacts is not of this run"));
  EXPECT_THAT(refusal(column("records/contacts/pictures/window/block/sums/force_x",
                             std::numeric_limits<double>::infinity())),
              EndsWith("records/contacts is not of this run"));
  EXPECT_THAT(refusal(column("records/lines/sums/parts", std::uint64_t{7})),
              EndsWith("records/lines is not of this run"));
  EXPECT_THAT(refusal(column("records/lines/last/step", std::uint64_t{1000})),
              EndsWith("records/lines is not of this run"));
  EXPECT_THAT(refusal(column("state/grains/particles/kind", std::uint16_t{9})),
              EndsWith("a particle is of no kind"));
  EXPECT_THAT(refusal(column("state/grains/seed", std::uint64_t{9})),
              EndsWith("the seed is not that of the scene"));
}

}  // namespace
}  // namespace clca::run::contact_run_test
