// What is counted, averaged or divided where grains come, leave or a stage ends.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "clca/model/initial_state.hpp"
#include "clca/record/quantity.hpp"
#include "clca/run/run.hpp"
#include "clca/run/simulation.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/table.hpp"
#include "clca/store/trajectory.hpp"
#include "support/runs.hpp"

namespace clca::run::edges_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;

class Edges : public ::testing::Test {
 protected:
  fs::path path(const std::string& name = "run") const { return folder_.path() / name; }
  store::RunSummary run_of(const std::string& text,
                           const std::vector<scene::Override>& overrides = {},
                           const std::string& name = "run") const {
    return run(scene::parse(text, "scene.yaml", overrides), {.folder = path(name)});
  }
  std::vector<double> column(const std::string& key,
                             const std::string& table = "series.csv") const {
    return store::read_table(path() / table).column_numbers(key);
  }

 private:
  testing::ScratchFolder folder_;
};

constexpr const char* kThreeFall = R"(clca: 1
seed: 1
box: {width: 20, height: 20}
species: {a: {shape: {hexagon: 1}}}
outlets: {o: {region: [0, 0, 20, 8]}}
stages: [{name: s, fill: {region: [0, 10, 20, 20], counts: {a: 3}}, until: {steps: 12}}]
output: {series: {every: 1}}
measure: [packing]
)";

TEST_F(Edges, AShareOfTheParticlesCountsThoseThatLeaveInTheStep) {
  run_of(kThreeFall);
  EXPECT_EQ(column("particles").back(), 0);
  EXPECT_THAT(column("moving_share"), Each(Le(1)));
  EXPECT_EQ(std::ranges::max(column("moving_share")), 1);
  const std::vector<double> moving = column("moving");
  const auto last = static_cast<std::size_t>(
      std::find_if(moving.rbegin(), moving.rend(), [](double all) { return all > 0; }).base() -
      moving.begin() - 1);
  EXPECT_EQ(column("moving_share")[last], 1) << "the last one moves, and leaves";
}

TEST_F(Edges, AnEmptyBoxHasNoMeanHeight) {
  const store::RunSummary summary = run_of(kThreeFall);
  EXPECT_TRUE(std::isnan(column("mean_height").back()));
  EXPECT_TRUE(std::isnan(testing::measure_of(summary, "s", "height_mean")));
}

// Its only grain slides into the outlet while it touches the wall below it.
constexpr const char* kLastSlides = R"(clca: 1
model: contact
box: {width: 30, height: 30}
species: {a: {shape: {hexagon: 1}}}
contact: {friction: 0, wall_friction: 0, restitution: 0}
walls: {slope: {line: {from: [0, 16], to: [14, 6], thickness: 2}}}
outlets: {o: {region: [7, 0, 30, 16]}}
stages: [{name: s, fill: {region: [1, 17, 6, 23], counts: {a: 1}}, until: {steps: 600}}]
output: {series: {every: 1, forces: true}}
measure: []
)";

TEST_F(Edges, ForcesOfAStepAfterWhichTheBoxIsEmptyAreFinite) {
  run_of(kLastSlides);
  ASSERT_EQ(column("particles").back(), 0);
  double most = 0;
  for (const double force : column("force_y.slope")) {
    ASSERT_TRUE(std::isnan(force) || std::abs(force) < 1e3) << force;
    most = std::isnan(force) ? most : std::max(most, std::abs(force));
  }
  EXPECT_GT(most, 0);
}

TEST_F(Edges, WhatAFillPutsIntoAnOutletIsInNoRate) {
  run_of(R"(clca: 1
model: contact
box: {width: 30, height: 30}
species: {a: {shape: {hexagon: 0}}}
units: {spacing: 1 mm, density: 2}
outlets: {o: {region: [0, 0, 30, 10]}}
stages:
  - {name: one, fill: {region: [0, 0, 30, 9], counts: {a: 20}}, until: {steps: 2}}
  - {name: two, fill: {region: [0, 0, 30, 9], counts: {a: 20}}, until: {steps: 2}}
output: {series: {every: 1}}
measure: []
)");
  ASSERT_EQ(column("discharged_particles").back(), 40);
  for (const double rate : column("particle_flow_rate")) {
    EXPECT_TRUE(std::isnan(rate) || rate == 0) << rate;
  }
}

TEST_F(Edges, ANoteSaysThatASideOfTheBoxHasEndedTheRunOut) {
  const auto notes_at = [&](const char* width) {
    return run(testing::bare_scene("wall-removal", {width}), {.folder = path(width)})
        .stages.at(1)
        .notes;
  };
  EXPECT_THAT(notes_at("box.width=110"), Contains(HasSubstr("a side of the box, which ends")));
  EXPECT_THAT(notes_at("box.width=400"), IsEmpty());
}

TEST_F(Edges, ASourceEmitsItsGrainsAtTheStepsOfItsRate) {
  struct Rate {
    const char* text;
    std::uint64_t grains;
    std::uint64_t steps;
  };
  for (const auto& [text, grains, steps] :
       {Rate{"0.2", 1, 5}, Rate{"=1/3", 1, 3}, Rate{"0.7", 7, 10}, Rate{"0.1", 1, 10},
        Rate{"0.3", 3, 10}, Rate{"=0.1*3", 3, 10}, Rate{"=22/7", 22, 7}, Rate{"0.125", 1, 8},
        Rate{"0.6", 3, 5}, Rate{"=1/49", 1, 49}, Rate{"1.1", 11, 10}, Rate{"1", 1, 1}}) {
    for (const char* model : {"automaton", "contact", "voids", "baxter"}) {
      Simulation simulation(
          scene::parse(fmt::format("clca: 1\nmodel: {}\nbox: {{width: 200, height: 60}}\n"
                                   "species: {{a: {{shape: {{hexagon: 0}}}}}}\n"
                                   "sources: {{s: {{region: [0, 30, 200, 60], rate: {}}}}}\n"
                                   "stages: [{{name: s, sources: [s], until: {{steps: 100}}}}]\n",
                                   model, text),
                       "scene.yaml"));
      for (std::uint64_t step = 1; step <= 100; ++step) {
        simulation.step();
        ASSERT_EQ(simulation.state().particles.size(), step * grains / steps)
            << text << " " << model << " " << step;
      }
    }
  }
}

TEST(ASource, DoesNotDriftAndKeepsTheUnitOfBinaryFractions) {
  const auto source = [](const std::string& rate) {
    return model::initial_state(
               scene::parse("clca: 1\nbox: {width: 9, height: 9}\n"
                            "species: {a: {shape: {hexagon: 0}}}\n"
                            "sources: {s: {at: [2, 2], rate: " +
                                rate + "}}\nstages: [{name: s, sources: [s], until: {steps: 1}}]\n",
                            "scene.yaml"))
        .sources.front();
  };
  for (const auto& [text, grains, steps] :
       {std::tuple("0.000001", 1, 1'000'000), std::tuple("0.123457", 123457, 1'000'000),
        std::tuple("=355/113", 355, 113), std::tuple("999.999", 999'999, 1000)}) {
    const grains::Source made = source(text);
    EXPECT_EQ(made.rate * static_cast<std::uint64_t>(steps),
              made.units_per_particle * static_cast<std::uint64_t>(grains))
        << text;
  }
  EXPECT_EQ(source("0.375").rate, std::uint64_t{3} << 29U);
  EXPECT_EQ(source("0.375").units_per_particle, std::uint64_t{1} << 32U);
}

// One grain falls, and lies on the floor from step 30 on or so.
constexpr const char* kOneGrain = R"(clca: 1
model: contact
box: {width: 8, height: 20}
species: {a: {shape: {hexagon: 1}}}
contact: {restitution: 0}
stages: [{name: s, fill: {region: [0, 10, 8, 14], counts: {a: 1}}, until: {steps: 120}}]
output:
  contacts: {window: 75}
  trajectory: {every: 30, contacts: true}
measure: []
)";

class FrameForces : public Edges {
 protected:
  /// Upwards on the grain, in the frames after the first.
  std::vector<double> forces(const std::string& name) const {
    const scene::Scene scene = scene::parse_file(path(name) / store::kSceneFile);
    store::Trajectory trajectory(path(name), scene, model::initial_state(scene), 1e9);
    std::vector<double> result;
    for (std::size_t frame = 1; frame < trajectory.frames().size(); ++frame) {
      result.push_back(0);
      for (const contact::Force& force : trajectory.contact_frame(frame).forces) {
        result.back() += force.on_upper().y();
      }
    }
    return result;
  }
  const std::vector<scene::Override> pictured = {
      "output.frames={every: 1000, overlay: forces, width: 64}"};
};

TEST_F(FrameForces, AreTheSameWhetherPicturesShowForcesOrNot) {
  run_of(kOneGrain, {}, "bare");
  run_of(kOneGrain, pictured, "pictured");
  EXPECT_EQ(forces("pictured"), forces("bare"));
}

TEST_F(FrameForces, DoNotKnowTheEndThatAStageHadBefore) {
  run_of(kOneGrain, {pictured[0], "stages.s.until.steps=200"}, "whole");
  run_of(kOneGrain, pictured, "prolonged");
  resume(load_run(path("prolonged"), 1e9, "200"), {});
  EXPECT_EQ(forces("prolonged"), forces("whole"));
}

TEST_F(FrameForces, AreThoseOfAnEndWrittenInStepsOrAsATime) {
  const std::vector<scene::Override> measured = {"measure=[force]"};
  const store::RunSummary steps = run_of(kOneGrain, measured, "steps");
  const double time = scene::unit_conversion(scene::parse(kOneGrain, "scene.yaml"))->time(120);
  const store::RunSummary in_time =
      run_of(kOneGrain, {measured[0], fmt::format("stages.s.until={{time: {}}}", time)}, "time");
  ASSERT_EQ(in_time.stages.front().steps, 120U);
  EXPECT_EQ(in_time.stages.front().measures, steps.stages.front().measures);
  EXPECT_EQ(forces("time"), forces("steps"));
}

constexpr const char* kDashes = R"(clca: 1
seed: 1
box: {width: 30, height: 40}
species: {a: {shape: {hexagon: 0}}, fine-1: {shape: {hexagon: 1}}}
outlets: {o: {region: [0, 0, 15, 6]}, o-1: {region: [15, 0, 30, 6]}}
sources: {sp-1: {region: [0, 20, 30, 40], species: {a: 1}, rate: 0.25}}
stages:
  - name: s
    sources: [sp-1]
    fill: {region: [0, 6, 30, 40], counts: {a: 30, fine-1: 7}}
    until: {steps: 80}
measure:
  right: =discharged.o-1
  difference: =discharged.o - 1
  fine: =discharged.o.fine-1
  both: =discharged.o-discharged.o-1
  twice: =2*sources.sp-1.rate-1
output: {}
)";

TEST_F(Edges, ADerivedMeasureTakesNamesWithADash) {
  const store::RunSummary summary = run_of(kDashes, {}, "dashes");
  const auto value = [&](const char* name) { return testing::measure_of(summary, "s", name); };
  EXPECT_EQ(value("right"), value("discharged.o-1"));
  EXPECT_EQ(value("difference"), value("discharged.o") - 1);
  EXPECT_EQ(value("fine"), value("discharged.o.fine-1"));
  EXPECT_EQ(value("both"), value("discharged.o") - value("discharged.o-1"));
  EXPECT_EQ(value("twice"), -0.5);
}

TEST(ADerivedMeasure, OfAnOutletOrSpeciesThatThereIsNotIsRefused) {
  for (const char* name :
       {"discharged.o.nosuch", "discharged.nosuch", "packing_fraction.o", "clogged.o.a"}) {
    EXPECT_THROW(record::check_derived(scene::parse(kDashes, "scene.yaml",
                                                    {fmt::format("measure={{f: ={}}}", name)})),
                 scene::SceneError)
        << name;
  }
  EXPECT_NO_THROW(record::check_derived(scene::parse(
      kDashes, "scene.yaml", {"measure={f: =clogged.o-1 + outflow_sites_per_step.o}"})));
}

}  // namespace
}  // namespace clca::run::edges_test
