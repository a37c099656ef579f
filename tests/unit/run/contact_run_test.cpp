// Runs of the contact model: what they leave, and that they go on as if they had never been
// stopped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "contact_runs.hpp"
#include "run/saved.hpp"
#include "support/run_folders.hpp"

namespace clca::run::contact_run_test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;

using ContactRunTest = ContactRuns;

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
  const store::ParsedTable walls = store::read_table(path() / "walls-rest.csv");
  EXPECT_THAT(*walls.find_column("wall"),
              ::testing::UnorderedElementsAre("left", "right", "floor", "top", "ceiling",
                                              "box.left", "box.right", "box.floor", "box.top"));
  const store::ParsedTable contacts = store::read_table(path() / "contacts-rest.csv");
  std::map<std::string, double> sums;  // of what carries weight
  for (std::size_t row = 0; row < contacts.row_count(); ++row) {
    const std::string& second = (*contacts.find_column("second"))[row];
    sums[second] +=
        contacts.column_numbers("normal_force")[row] * contacts.column_numbers("normal_y")[row] +
        contacts.column_numbers("shear_force")[row] * contacts.column_numbers("normal_x")[row];
  }
  for (std::size_t row = 0; row < walls.row_count(); ++row) {
    const std::string& wall = (*walls.find_column("wall"))[row];
    EXPECT_NEAR(-walls.column_numbers("force_y")[row], sums[wall], 1e-9) << wall;
  }
  EXPECT_GT(sums["floor"], 1);
  EXPECT_GT(sums["box.floor"], 1);
}

TEST_F(ContactRunTest, RunJsonHasTheSidesOfItsBox) {
  const auto box = run(small({"box.periodic=true"}), {.folder = path()}).box;
  ASSERT_TRUE(box);
  EXPECT_EQ(box->left, -lattice::kColumnPitch / 2);
  EXPECT_DOUBLE_EQ(box->right, 47.5 * lattice::kColumnPitch);  // 48 columns
  EXPECT_EQ(box->floor, -0.5);
  EXPECT_EQ(box->top, 60);
  EXPECT_TRUE(box->periodic);
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
  const store::ParsedTable walls = store::read_table(path() / "walls-rest.csv");
  for (std::size_t row = 0; row < walls.row_count(); ++row) {
    if ((*walls.find_column("wall"))[row] == "floor") {
      EXPECT_NEAR(walls.column_numbers("force_y")[row], -1, 1e-3);
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
            {.folder = path(), .replace_interrupted = true});
    EXPECT_GE(summary.stages[1].steps, 60U) << seed;
  }
}

TEST_F(ContactRunTest, TheReferenceEngineLeavesTheSameRun) {
  const auto fast = run(small(), {.folder = path("fast"), .threads = 2});
  const auto reference = run(small(), {.folder = path("reference"), .use_reference_step = true});
  EXPECT_EQ(reference.state_hash, fast.state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("fast"), path("reference")), "");
}

TEST_F(ContactRunTest, TheReferenceEngineOfTheAutomatonLeavesTheSameRun) {
  const auto scene = small({"model=automaton", "walls.gate={box: [20, 0, 21, 60]}",
                            "output.frames.color_by=species", "output.frames.overlay=none"});
  const auto fast = run(scene, {.folder = path("fast"), .threads = 2});
  const auto reference = run(scene, {.folder = path("reference"), .use_reference_step = true});
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
  run(small(), {.folder = path(), .stop_signal = &stop}, events);
  for (const std::uint64_t next : {7U, 133U, 257U, 300U, 301U, 444U}) {
    until = next;
    stop = 0;
    EXPECT_EQ(resume(load_run(path(), kMuch),
                     {.use_reference_step = next == 133U, .stop_signal = &stop}, events)
                  .status,
              "interrupted");
  }
  EXPECT_EQ(resume(load_run(path(), kMuch), {.wall_seconds_limit = 0.0}).status, "interrupted");
  EXPECT_EQ(resume(load_run(path(), kMuch), {}).state_hash, expected.state_hash);
  EXPECT_EQ(testing::difference_of_runs(path("unbroken"), path()), "");
}

// Contents that no run has saved, under a right checksum.
TEST_F(ContactRunTest, AHostileCheckpointIsRefused) {
  std::atomic<int> stop = 0;
  run(small(), {.folder = path(), .stop_signal = &stop},
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
      resume(load_run(path(), kMuch), {.stop_signal = &at_once});
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
  EXPECT_THAT(refusal(column("records/contacts/pictures/window/block/sums/force/x",
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
