#include "clca/run/run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "clca/automaton/automaton.hpp"
#include "clca/image/png.hpp"
#include "clca/run/setup.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "support/runs.hpp"

namespace clca::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSmallScene = R"(clca: 1
title: A small collapse
seed: 5
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
  rod: {shape: {rod: {radius: 0, length: 3}}, orientations: any}
walls:
  gate: {box: [30, 0, 31, 60]}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 60], counts: {small: 30, rod: 30}}
  - name: flow
    remove: [gate]
output:
  frames: {every: 10, width: 160, height: 120}
  series: {every: 1}
)";

scene::Scene small_scene(const std::vector<scene::Override>& overrides = {}) {
  return scene::parse(kSmallScene, "small.yaml", overrides);
}

nlohmann::json json_of(const fs::path& file) {
  const auto bytes = testing::bytes_of(file);
  return nlohmann::json::parse(bytes);
}

TEST(Setup, KeepsOneKindPerOrientationThatLooksDifferent) {
  const grains::State state = initial_state(small_scene());
  ASSERT_EQ(state.kinds.size(), 1U + 3U);  // the hexagon, and the rod in three directions
  EXPECT_EQ(state.kinds[3].species, 1);
}

TEST(Setup, GivesWallsTheirMotionAndLeavesOutThoseThatComeLater) {
  const grains::State state = initial_state(small_scene(
      {"walls={plate: {box: [1, 70, 9, 74], motion: {direction: down, distance: 30}, passive: "
       "overlap}, post: {box: [2, 0, 4, 3]}}",
       "stages=[{name: first, fill: {region: [10, 0, 20, 40], counts: {small: 1, rod: 1}}}, {name: "
       "second, insert: [plate], move: [plate]}]"}));
  ASSERT_EQ(state.walls.size(), 2U);
  EXPECT_FALSE(state.walls[0].present);
  EXPECT_EQ(state.walls[0].motion,
            (grains::WallMotion{lattice::Direction::down, grains::Drive{1, 30}}));
  EXPECT_EQ(state.walls[0].passive, grains::Passive::overlap);
  EXPECT_FALSE(state.walls[0].sites.empty()) << "outside the box at home";
  EXPECT_TRUE(state.walls[1].present);
  EXPECT_FALSE(state.walls[1].motion.has_value());
}

TEST(Setup, WhereTheCoordinatesOfAShapeStartDoesNotMatter) {
  const auto near = small_scene({"species.rod.shape={sites: [[0, 0], [1, 0], [2, 0]]}"});
  const auto far = small_scene({"species.rod.shape={sites: [[90, 7], [91, 7], [92, 7]]}"});
  EXPECT_EQ(initial_state(near).kinds, initial_state(far).kinds);
}

TEST(Run, LeavesAWholeRunFolder) {
  const testing::ScratchFolder folder;
  const auto summary = run(small_scene(), {.folder = folder.path() / "out"});
  const fs::path out = folder.path() / "out";
  const auto json = json_of(out / "run.json");
  EXPECT_EQ(json["status"], "done");
  EXPECT_EQ(json["particles"], 60);
  EXPECT_EQ(json["steps"], summary.steps);
  EXPECT_EQ(json["stages"].size(), 2U);
  EXPECT_EQ(json["stages"][1]["ended"], "settled");
  EXPECT_TRUE(fs::exists(out / "profile-packing.csv"));
  EXPECT_TRUE(fs::exists(out / "profile-flow.csv"));
  EXPECT_TRUE(fs::exists(out / "log.txt"));
  const auto steps = testing::csv_column(out / "series.csv", "step");
  ASSERT_EQ(steps.size(), summary.steps + 1);  // step 0 and each step once
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i], static_cast<double>(i));
  }
}

TEST(Run, ItsResolvedSceneGivesTheSameRunAgain) {
  const testing::ScratchFolder folder;
  const auto first = run(small_scene(), {.folder = folder.path()});
  const auto second =
      run(scene::parse_file(folder.path() / "scene.yaml"), {.folder = folder.path() / "again"});
  EXPECT_EQ(first.state_hash, second.state_hash);
}

TEST(Run, AStageMayHaveRulesAndFrictionOfItsOwn) {
  const testing::ScratchFolder folder;
  const auto hash = [&](std::vector<scene::Override> overrides) {
    overrides.insert(overrides.end(), {"output={}", "species.rod.shape={hexagon: 2}"});
    return run(small_scene(overrides), {.folder = folder.path() / "out"}).state_hash;
  };
  const auto steep_flow = hash({"stages.flow.rules.inertia=0"});
  EXPECT_EQ(hash({"rules.inertia=0", "stages.packing.rules.inertia=0.9"}), steep_flow);
  EXPECT_NE(hash({"rules.inertia=0"}), steep_flow);
  EXPECT_NE(hash({}), steep_flow);
  const std::string contact = "model=contact";
  const auto rough_flow = hash({contact, "stages.packing.contact.friction=0"});
  EXPECT_EQ(hash({contact, "contact.friction=0", "stages.flow.contact.friction=0.4"}), rough_flow);
  EXPECT_NE(hash({contact}), rough_flow);
}

TEST(Run, PicturesSayWhereTheyComeFrom) {
  const testing::ScratchFolder folder;
  run(small_scene(), {.folder = folder.path()});
  const fs::path first = folder.path() / "frames" / "small-000000.png";
  const auto png = image::decode_png(testing::bytes_of(first));
  EXPECT_EQ(png.image.width, 160);
  EXPECT_EQ(png.text.at("Scene"), "small");
  EXPECT_EQ(png.text.at("Seed"), "5");
  EXPECT_EQ(png.text.at("Step"), "0");
  EXPECT_EQ(png.text.at("Software"), "clca " + version());
}

TEST(Run, AFillThatDoesNotFitSaysHowManyFittedAndMakesNoFolder) {
  const testing::ScratchFolder folder;
  const auto scene = small_scene({"stages.packing.fill.counts.small=285"});
  EXPECT_THAT([&] { run(scene, {.folder = folder.path() / "out"}); },
              ::testing::ThrowsMessage<SceneRunError>(::testing::AllOf(
                  ::testing::StartsWith("small.yaml:12:11: error: the fill of stage packing"),
                  ::testing::HasSubstr("of 285 small"), ::testing::HasSubstr("enlarge"))));
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(Run, StopsWhenAskedWithEverythingWritten) {
  const testing::ScratchFolder folder;
  std::atomic<int> stop = 2;
  const auto summary = run(small_scene(), {.folder = folder.path(), .stop = &stop});
  EXPECT_EQ(summary.status, "interrupted");
  EXPECT_EQ(json_of(folder.path() / "run.json")["status"], "interrupted");
}

TEST(Run, EndsAStageAtItsBoundWithAWarning) {
  const testing::ScratchFolder folder;
  std::vector<std::string> warnings;
  const auto summary = run(small_scene({"stages.packing.max_steps=7"}), {.folder = folder.path()},
                           {.warning = [&](const std::string& text) { warnings.push_back(text); }});
  EXPECT_EQ(summary.stages[0].steps, 7U);
  EXPECT_EQ(summary.stages[0].ended, "bound");
  EXPECT_THAT(warnings, ::testing::Contains(::testing::HasSubstr("stage packing")));
}

TEST(Run, RunsAStageForAGivenNumberOfSteps) {
  const testing::ScratchFolder folder;
  const auto summary =
      run(small_scene({"stages.packing.until={steps: 33}"}), {.folder = folder.path()});
  EXPECT_EQ(summary.stages[0].steps, 33U);
  EXPECT_EQ(summary.stages[0].ended, "steps");
}

TEST(Run, DrawsTheFinalStateAloneWhenAskedAndIsTheSameRun) {
  const testing::ScratchFolder folder;
  const auto course = run(small_scene(), {.folder = folder.path() / "course"});
  const auto last =
      run(small_scene(), {.folder = folder.path() / "last", .last_picture_only = true});
  EXPECT_EQ(last.state_hash, course.state_hash);
  const fs::path frames = folder.path() / "last" / "frames";
  ASSERT_EQ(std::distance(fs::directory_iterator(frames), fs::directory_iterator()), 1);
  EXPECT_EQ(fs::directory_iterator(frames)->path(),
            store::frame_path(folder.path() / "last", "small", last.steps));
}

TEST(Run, AFolderThatCannotBeWrittenIsAnErrorWithItsPath) {
  const testing::ScratchFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  EXPECT_THAT([&] { run(small_scene(), {.folder = folder.path() / "file" / "out"}); },
              ::testing::ThrowsMessage<store::StoreError>(::testing::HasSubstr("file/out")));
}

}  // namespace
}  // namespace clca::run
