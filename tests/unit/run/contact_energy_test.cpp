// Energy in runs of the contact model: its balance, that none is gained, and what is said where
// some is.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "contact_runs.hpp"
#include "record/energy_record.hpp"
#include "run/stage.hpp"
#include "support/run_folders.hpp"

namespace clca::run::contact_energy_test {
namespace {

using ::testing::HasSubstr;

using ContactEnergyTest = ContactRuns;

// Shapes that lock into one another: none gets faster where it is. Once by 62 %.
TEST_F(ContactEnergyTest, ABedOfShapesThatInterlockGainsNoEnergy) {
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
            {.folder = path(), .replace_interrupted = true});
    EXPECT_LT(testing::measure_of(summary, "bed", "energy_growth"), 0.002) << seed;
    EXPECT_EQ(summary.stages.front().end_reason, "settled") << seed;
  }
}

// The grain touches a side all the time, so that it rests where it turns.
TEST_F(ContactEnergyTest, RestLiftsNoGrain) {
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

TEST_F(ContactEnergyTest, TheSeriesHasItsEnergies) {
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

TEST_F(ContactEnergyTest, WhatIsDissipatedClosesTheBalance) {
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

// By default a grain moves a site a step at most where it falls freely. Where it is made to fall
// faster than it can move, it loses velocity and energy, and a line says so.
TEST_F(ContactEnergyTest, AGrainThatFallsFarGainsNoEnergy) {
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
    run(scene::parse(kTall, "tall.yaml", overrides),
        {.folder = path(), .replace_interrupted = true}, events);
    const store::ParsedTable series = store::read_table(path() / "series.csv");
    const double whole =
        series.column_numbers("kinetic_energy")[0] + series.column_numbers("potential_energy")[0];
    const std::vector<double> dissipated = series.column_numbers("dissipated_energy");
    EXPECT_GT(*std::min_element(dissipated.begin(), dissipated.end()), -0.002 * whole);
    if (is_default) {
      EXPECT_EQ(warnings, "");
    } else {
      EXPECT_THAT(warnings, HasSubstr("a grain falls faster than it can move, and loses velocity"));
    }
  }
}

TEST_F(ContactEnergyTest, EnergyThatFallsWithoutEndIsMeasuredByItsFall) {
  const auto scene = small();
  model::SceneModel model(scene, state_at_start(scene), {});
  prepare_stage(model, scene, 0);
  record::EnergyRecord record(scene);
  record.begin(scene.stages.front(), model);
  const double start = model.contact()->energy().sum();
  EXPECT_FALSE(record.add_step(model, {.sources = 100 * start}));
  EXPECT_EQ(record.energy_growth().value(), 0);
  EXPECT_FALSE(record.add_step(model, {.outlets = 0.3 * start}));
  EXPECT_NEAR(record.energy_growth().value(), 0.003, 1e-12);
}

TEST_F(ContactEnergyTest, EnergyThatGrowsIsToldOnce) {
  const auto scene = small();
  model::SceneModel model(scene, state_at_start(scene), {});
  prepare_stage(model, scene, 0);
  record::EnergyRecord record(scene);
  record.begin(scene.stages.front(), model);
  const double start = model.contact()->energy().sum();
  EXPECT_FALSE(record.add_step(model, {.outlets = 0.008 * start}));
  EXPECT_THAT(record.add_step(model, {.outlets = 0.004 * start}).value(),
              HasSubstr(fmt::format("from {0:.0f} to {1:.0f}, by 1.2 % of the {0:.0f}", start,
                                    1.012 * start)));
  EXPECT_NEAR(record.energy_growth().value(), 0.012, 1e-12);
  EXPECT_FALSE(record.add_step(model, {.outlets = start}));
  record.begin(scene.stages.back(), model);  // with a source
  EXPECT_FALSE(record.energy_growth());
}

TEST_F(ContactEnergyTest, TheSeriesOfAnAutomatonHasNone) {
  run(small({"model=automaton", "walls.gate={box: [20, 0, 21, 60]}",
             "output.frames.color_by=species", "output.frames.overlay=none"}),
      {.folder = path()});
  EXPECT_THROW(testing::csv_column(path() / "series.csv", "kinetic_energy"), std::out_of_range);
}

}  // namespace
}  // namespace clca::run::contact_energy_test
