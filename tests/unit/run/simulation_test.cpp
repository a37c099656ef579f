#include "clca/run/simulation.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "support/runs.hpp"

namespace clca::simulation_test {
namespace {

constexpr const char* kScene = R"(clca: 1
box: {width: 40, height: 60}
species:
  grain: {shape: {hexagon: 1}}
walls:
  gate: {box: [20, 0, 21, 60]}
outlets:
  end: {region: [35, 0, 40, 60]}
stages:
  - {name: packing, fill: {region: [0, 0, 20, 60], counts: {grain: 60}}, until: {steps: 60}}
  - {name: flow, remove: [gate], until: {steps: 90}}
output: {frames: none, series: none}
)";

scene::Scene scene_of(const std::string& model) {
  return scene::parse(kScene, "small.yaml", {"model=" + model, "measure={ratio: =runout_99 / 30}"});
}

TEST(Simulation, HasTheBitsAndTheMeasuresOfARun) {
  for (const char* model : {"automaton", "contact"}) {
    const scene::Scene scene = scene_of(model);
    const testing::ScratchFolder folder;
    const store::RunSummary summary = run::run(scene, {.folder = folder.path() / "run"});
    run::Simulation simulation(scene);
    while (!simulation.is_over()) {
      simulation.step();
      if (!simulation.stage_end_text().empty()) {
        const store::StageSummary& stage = summary.stages.at(simulation.stage_index());
        EXPECT_EQ(simulation.stage_end_text(), stage.end_reason);
        EXPECT_EQ(simulation.measures(), stage.measures) << model;
      }
    }
    EXPECT_EQ(simulation.state().step, summary.steps);
    EXPECT_EQ(simulation.state_hash(), summary.state_hash) << model;
    EXPECT_THROW(simulation.step(), std::logic_error);
    EXPECT_THROW(simulation.begin_next_stage(), std::logic_error);
  }
}

TEST(Simulation, GivesOneMeasureAlone) {
  run::Simulation simulation(scene_of("automaton"));
  simulation.step();
  const auto packing = simulation.measures(scene::Measure::packing);
  ASSERT_FALSE(packing.empty());
  EXPECT_EQ(packing.front().first, "packing_fraction");
  EXPECT_LT(packing.size(), simulation.measures().size());
}

TEST(Simulation, AHeldStateStaysAsItsStageLeftIt) {
  for (const char* model : {"automaton", "contact"}) {
    run::Simulation simulation(scene_of(model));
    const auto held = simulation.shared_state();
    EXPECT_EQ(held.get(), &simulation.state());
    while (simulation.stage_end_text().empty()) {
      simulation.step();
    }
    const grains::State end = *held;
    simulation.step();
    EXPECT_EQ(simulation.stage_index(), 1);
    EXPECT_NE(held.get(), &simulation.state());
    EXPECT_EQ(*held, end) << model;
  }
}

}  // namespace
}  // namespace clca::simulation_test
