// Runs that begin with the particles of another run.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "clca/run/run.hpp"
#include "clca/run/setup.hpp"
#include "model/internal/scene_model.hpp"
#include "run/stage.hpp"
#include "support/runs.hpp"

namespace clca::run::other_run_test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr double kMuch = 1e9;

constexpr const char* kPacking = R"(clca: 1
seed: 3
box: {width: 40, height: 60}
species:
  small: {shape: {hexagon: 1}}
  rod: {shape: {rod: {radius: 0, length: 3}}, orientations: any}
walls: {gate: {box: [20, 0, 21, 60]}}
stages:
  - name: packing
    fill: {region: [0, 0, 20, 60], counts: {small: 40, rod: 10}}
output: {trajectory: {every: 10}}
)";

constexpr const char* kFlow = R"(clca: 1
begin: {run: packing}
box: {width: 60, height: 60}
species:
  large: {shape: {hexagon: 2}}
  rod: {shape: {rod: {radius: 0, length: 3}}, orientations: [120, 60, 0]}
  small: {shape: {hexagon: 1}}
walls: {gate: {box: [20, 0, 21, 60]}}
stages:
  - name: flow
    remove: [gate]
output: {series: {every: 1}}
)";

class OtherRunTest : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }
  store::RunSummary pack(const std::vector<scene::Override>& overrides = {}) const {
    return run(scene::parse(kPacking, "packing.yaml", overrides),
               {.folder = path("packing"), .replace_interrupted = true});
  }
  scene::Scene flow(const std::vector<scene::Override>& overrides = {}) const {
    return scene::parse(kFlow, path("flow.yaml").string(), overrides);
  }
  std::string refusal(const std::vector<scene::Override>& overrides = {}) const {
    try {
      try_start(flow(overrides));
    } catch (const scene::SceneError& error) {
      return error.what();
    }
    return "";
  }
  /// Where the particles are that a run begins with, and what they are.
  static std::vector<std::pair<Eigen::Vector2d, std::string>> places(const model::ModelState& state,
                                                                     const scene::Scene& scene) {
    std::vector<std::pair<Eigen::Vector2d, std::string>> result;
    const grains::State& grains = model::grains_of(state);
    for (const grains::Particle& particle : grains.particles) {
      result.emplace_back(grains::centre(grains, particle),
                          scene.species[grains.kinds[particle.kind].species].name);
    }
    return result;
  }
  model::ModelState end(const std::string& name) const {
    const SavedRun saved = load_run(path(name), kMuch, "1000000");
    return model::state_from_checkpoint(std::get<scene::Scene>(saved.scene),
                                        saved.checkpoint.fields, kMuch);
  }

  testing::ScratchFolder folder_;
};

TEST_F(OtherRunTest, BeginsWithTheLastStateOfTheOtherRun) {
  pack();
  EXPECT_EQ(places(state_at_start(flow()), flow()),
            places(end("packing"), scene::parse(kPacking, "packing.yaml")));
}

TEST_F(OtherRunTest, GoesOnAsAnyRunAndSaysWhereItBegan) {
  const auto packing = pack();
  const auto summary = run(flow(), {.folder = path("flow")});
  EXPECT_EQ(summary.particles, 50U);
  EXPECT_EQ(summary.stages.front().end_reason, "settled");
  EXPECT_GT(summary.steps, 10U);
  const auto begin = nlohmann::json::parse(testing::bytes_of(path("flow/run.json")))["begin"];
  EXPECT_EQ(begin["run"], path("packing").string());
  EXPECT_EQ(begin["step"], "last");
  ASSERT_TRUE(summary.begin.has_value());
  EXPECT_EQ(summary.begin->state_hash, packing.state_hash);
  EXPECT_EQ(begin["state_hash"], fmt::format("{:016x}", packing.state_hash));
}

TEST_F(OtherRunTest, WhatLiesInAnOutletLeavesAtOnce) {
  for (const char* model : {"automaton", "contact"}) {
    const std::vector<scene::Override> one = {std::string("model=") + model,
                                              "species={small: {shape: {hexagon: 1}}}"};
    std::vector<scene::Override> there = one;
    there.emplace_back("stages.packing.fill.counts={small: 40}");
    pack(there);
    std::vector<scene::Override> here = one;
    here.emplace_back("outlets={drain: {region: [0, 0, 20, 8]}}");
    const auto summary = run(flow(here), {.folder = path("flow"), .replace_interrupted = true});
    const auto left = testing::csv_column(path("flow/series.csv"), "discharged_particles");
    const auto inside = testing::csv_column(path("flow/series.csv"), "particles");
    EXPECT_GT(left.front(), 0) << model;
    EXPECT_EQ(left.front() + inside.front(), 40) << model;
    EXPECT_EQ(testing::measure_of(summary, "flow", "discharged"), left.back()) << model;
  }
}

TEST_F(OtherRunTest, ItsResolvedSceneGivesTheSameRunAgainAndNoOther) {
  pack();
  const auto first = run(flow(), {.folder = path("flow")});
  const scene::Scene again = scene::parse_file(path("flow/scene.yaml"));
  EXPECT_EQ(run(again, {.folder = path("again")}).state_hash, first.state_hash);
  pack({"seed=4"});
  EXPECT_THAT([&] { try_start(again); },
              ::testing::ThrowsMessage<scene::SceneError>(
                  HasSubstr("begin: the state in " + path("packing").string() + " has changed")));
}

TEST_F(OtherRunTest, ResumesWithoutTheOtherRun) {
  pack();
  const auto whole = run(flow({"stages.flow.until={steps: 30}"}), {.folder = path("whole")});
  run(flow({"stages.flow.until={steps: 1}"}), {.folder = path("broken")});
  // As if it had been killed at once: the checkpoint before the last is that of its beginning.
  fs::rename(path("broken/checkpoint-previous.clca"), path("broken/checkpoint.clca"));
  fs::remove_all(path("packing"));
  const auto resumed = resume(load_run(path("broken"), kMuch, "30"), {});
  EXPECT_EQ(resumed.state_hash, whole.state_hash);
  ASSERT_TRUE(resumed.begin.has_value());
  EXPECT_EQ(resumed.begin->state_hash, whole.begin->state_hash);
}

TEST_F(OtherRunTest, BeginsWithAStepOfTheTrajectory) {
  pack();
  const auto early = flow({"begin.step=10"});
  const auto late = flow();
  EXPECT_NE(places(state_at_start(early), early), places(state_at_start(late), late));
  EXPECT_EQ(model::grains_of(state_at_start(early)).particles.size(), 50U);
  EXPECT_THAT(refusal({"begin.step=11"}), EndsWith("the trajectory in " + path("packing").string() +
                                                   " has no frame of step 11"));
}

TEST_F(OtherRunTest, LeavesOutWhatHasLeftTheOtherRun) {
  pack({"outlets={drain: {region: [0, 0, 8, 6]}}"});
  const std::size_t left = grains::present_count(model::grains_of(end("packing")));
  ASSERT_LT(left, 50U);
  const auto state = state_at_start(flow());
  EXPECT_EQ(model::grains_of(state).particles.size(), left);
  EXPECT_EQ(grains::present_count(model::grains_of(state)), left);
}

TEST_F(OtherRunTest, GoesFromEitherModelToTheOther) {
  const std::vector<scene::Override> contact = {"model=contact", "contact={rolling: none}"};
  pack();
  const scene::Scene by_contact = flow(contact);
  const model::ModelState still = state_at_start(by_contact);
  EXPECT_EQ(places(still, by_contact), places(state_at_start(flow()), flow()));
  EXPECT_EQ(std::get<contact::State>(still).velocities,
            std::vector<contact::Velocity<std::int32_t>>(50));
  EXPECT_EQ(run(by_contact, {.folder = path("flow")}).stages.front().end_reason, "settled");
  pack({"model=contact", "contact={rolling: none}"});
  EXPECT_EQ(
      run(flow(), {.folder = path("back"), .replace_interrupted = true}).stages.front().end_reason,
      "settled");
}

TEST_F(OtherRunTest, GrainsWithAnAxisKeepItAndThoseWithoutGetOne) {
  const std::string one_site = "species={small: {shape: {hexagon: 0}}}";
  const auto axes = [](const model::ModelState& state) {
    std::vector<std::uint16_t> result;
    for (const grains::Particle& particle : model::grains_of(state).particles) {
      result.push_back(baxter::axis_of(particle));
    }
    return result;
  };
  const std::vector<scene::Override> baxter = {"model=baxter", one_site};
  pack({"model=baxter", one_site, "stages.packing.fill.counts={small: 40}"});
  EXPECT_EQ(axes(state_at_start(flow(baxter))), axes(end("packing")));
  pack({one_site, "stages.packing.fill.counts={small: 40}"});
  const std::vector<std::uint16_t> drawn = axes(state_at_start(flow(baxter)));
  EXPECT_EQ(std::set(drawn.begin(), drawn.end()), (std::set<std::uint16_t>{0, 1, 2}));
}

TEST_F(OtherRunTest, GrainsOfTheContactModelKeepTheirVelocities) {
  pack({"model=contact", "contact={rolling: none, fall_height: 40}",
        "stages.packing.until={steps: 30}"});
  const auto there = std::get<contact::State>(end("packing"));
  const auto same = std::get<contact::State>(
      state_at_start(flow({"model=contact", "contact={rolling: none, fall_height: 40}"})));
  EXPECT_EQ(same.velocities, there.velocities);
  EXPECT_EQ(same.remainders, there.remainders);
  // Steps of half the length.
  const auto slow = std::get<contact::State>(
      state_at_start(flow({"model=contact", "contact={rolling: none, fall_height: 160}"})));
  for (std::size_t id = 0; id < there.velocities.size(); ++id) {
    EXPECT_NEAR(slow.velocities[id].y, there.velocities[id].y / 2.0, 1e-3 * contact::kSpacing);
  }
}

TEST_F(OtherRunTest, ABedOfTheContactModelAtRestStaysAtRest) {
  pack({"model=contact", "contact={rolling: none}"});
  const std::vector<scene::Override> rest = {"model=contact", "contact={rolling: none}",
                                             "stages=[{name: rest, until: {steps: 100}}]",
                                             "walls={post: {box: [20, 0, 21, 60]}}"};
  const auto summary = run(flow(rest), {.folder = path("rest")});
  EXPECT_EQ(testing::measure_of(summary, "rest", "moved_share"), 0);
  EXPECT_GT(std::get<contact::State>(state_at_start(flow(rest))).contacts.size(), 50U);
}

TEST_F(OtherRunTest, BeginsInTheMiddleOfImpactsWithAnotherTimeStep) {
  const std::string grains =
      "clca: 1\nseed: 3\nmodel: contact\nbox: {width: 20, height: 60}\n"
      "species: {a: {shape: {hexagon: 1}}}\n";
  // The next run's steps are shorter: grains may fall from the top of its box.
  for (const int steps : {80, 95, 100}) {
    run(scene::parse(grains + "stages: [{name: fall, until: {steps: " + std::to_string(steps) +
                         "}, fill: {region: [0, 0, 20, 40], counts: {a: 8}}}]\n",
                     "packing.yaml"),
        {.folder = path("packing"), .replace_interrupted = true});
    const auto next = run(scene::parse(grains + "begin: {run: packing}\n"
                                                "stages: [{name: on, until: {steps: 10}}]\n",
                                       path("next.yaml").string()),
                          {.folder = path("next"), .replace_interrupted = true});
    EXPECT_EQ(next.steps, 10);
  }
}

TEST_F(OtherRunTest, RefusesWhatItCannotBeginWith) {
  const std::string folder = path("packing").string();
  EXPECT_THAT(refusal(), EndsWith("flow.yaml:2:8: error: begin: cannot read " + folder +
                                  "/run.json: No such file or directory"));
  pack();
  EXPECT_EQ(refusal(), "");
  EXPECT_THAT(refusal({"box.height=10", "walls={gate: {box: [20, 0, 21, 10]}}"}),
              HasSubstr(" of the 50 particles in " + folder +
                        " lie outside the box, on a wall or on another particle, the first at ["));
  EXPECT_THAT(refusal({"walls.gate.box=[0, 0, 9, 3]"}), HasSubstr("on a wall"));
  EXPECT_THAT(refusal({"species={rod: {shape: {rod: {radius: 0, length: 3}}, orientations: any}}"}),
              EndsWith("has particles of a species 'small', the scene has none"));
  EXPECT_THAT(refusal({"species.small.shape={hexagon: 2}"}),
              HasSubstr("particles of species 'small' in " + folder + " have a shape"));
  EXPECT_THAT(refusal({"species.rod.orientations=[0]"}),
              HasSubstr("particles of species 'rod' in " + folder + " have a shape"));
  pack({"output={checkpoint: none}"});
  EXPECT_THAT(refusal(), HasSubstr("has kept no checkpoint of its end"));
  pack({"outlets={drain: {region: [0, 0, 60, 60]}}"});
  EXPECT_THAT(refusal(), EndsWith("no particles are left in " + folder));
}

TEST_F(OtherRunTest, APeriodicBoxTakesNoParticlesFromBeyondItsWidth) {
  pack({"box.width=80", "walls.gate.box=[40, 0, 41, 60]", "stages.0.fill.region=[0, 0, 40, 60]"});
  const std::vector<scene::Override> narrow = {"box={width: 26, height: 60, periodic: true}",
                                               "stages=[{name: flow}]", "walls={}"};
  EXPECT_THAT(refusal(narrow), HasSubstr("lie outside the box"));
  EXPECT_EQ(
      refusal({"box={width: 80, height: 60, periodic: true}", "stages=[{name: flow}]", "walls={}"}),
      "");
}

TEST_F(OtherRunTest, DoesNotReplaceTheRunThatItBeginsWith) {
  pack();
  EXPECT_THAT([&] { run(flow(), {.folder = path("packing")}); },
              ::testing::ThrowsMessage<scene::SceneError>(HasSubstr("would replace the one in")));
}

}  // namespace
}  // namespace clca::run::other_run_test
