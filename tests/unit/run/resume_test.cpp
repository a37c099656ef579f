// Runs that go on where they saved themselves end as if they had never been stopped.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::run::resume_test {
namespace {

namespace fs = std::filesystem;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr double kMuch = 1e9;

/// A scene of its own for what a run has to remember, and the key of its last end.
struct Course {
  const char* name;
  std::vector<scene::Override> overrides;
  std::string until;  // as in a scene: of the unbroken run
  std::vector<int> stops;
};

const std::vector<Course>& courses() {
  static const std::string outputs =
      "output={series: {every: 7}, fields: {every: 40}, trajectory: {every: 9}, "
      "checkpoint: {every: 1000000}}";
  static const std::vector<Course> all = {
      {"wall-removal",
       {outputs, "stages.flow.rules={inertia: 0.2}"},
       "{steps: 90}",
       {1, 9, 40, 63, 89}},
      {"silo-discharge",
       {"output={series: {every: 7}, fields: {every: 40}, trajectory: {every: 9}, checkpoint: "
        "{every: 1000000}}"},
       "{steps: 120}",
       {1, 30, 77}},
      {"two-orifices",
       {outputs, "probes={neck: [30, 42, 44, 60], low: [100, 0, 140, 40]}",
        "lines={throat: {from: [30, 42], to: [44, 42]}, up: {from: [60, 50], to: [80, 90]}}"},
       "{steps: 120}",
       {1, 30, 77}},
      {"mixing",
       {outputs, "model=voids", "let.d=1.05", "species.small.shape.hexagon=0",
        "species.large.shape.hexagon=0"},
       "{steps: 90}",
       {1, 30, 77}},
      {"outlet",
       {outputs, "model=baxter", "let.d=1.05", "species.small.shape.hexagon=0",
        "species.large.shape.hexagon=0"},
       "{steps: 90}",
       {1, 30, 77}},
      {"brazil-nut", {outputs}, "{steps: 200}", {1, 12, 60, 61, 150}},
      {"convection", {outputs}, "{steps: 150}", {5, 44, 121}},
      {"plate-penetration",
       {"output={series: {every: 7}, fields: {every: 40}, contacts: {every: 3}, trajectory: "
        "{every: 9}, checkpoint: {every: 1000000}}"},
       "{steps: 200}",
       {3, 50, 150}}};
  return all;
}

class Resume : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Course& course() const { return courses()[GetParam()]; }
  /// The scene with the last stage ending so.
  scene::Scene scene(const std::string& until) const {
    std::vector<scene::Override> overrides = course().overrides;
    const scene::Scene whole = testing::bare_scene(course().name, {});
    overrides.push_back("stages." + std::to_string(whole.stages.size() - 1) + ".until=" + until);
    return scene::parse_file(CLCA_SOURCE_DIR "/scenes/" + std::string(course().name) + ".yaml",
                             overrides);
  }

  testing::ScratchFolder folder_;
};

TEST_P(Resume, ProlongedTimeAndAgainARunIsTheSameAsInOneGo) {
  const fs::path unbroken = folder_.path() / "unbroken";
  const fs::path broken = folder_.path() / "broken";
  const auto expected = run(scene(course().until), {.folder = unbroken});
  EXPECT_EQ(expected.status, "done");
  run(scene("{steps: " + std::to_string(course().stops.front()) + "}"), {.folder = broken});
  for (const int stop : course().stops) {
    resume(load_run(broken, kMuch, std::to_string(stop)), {.threads = 2});
  }
  const auto resumed = resume(load_run(broken, kMuch, course().until), {});
  EXPECT_EQ(resumed.state_hash, expected.state_hash);
  EXPECT_EQ(testing::difference_of_runs(unbroken, broken), "");
}

INSTANTIATE_TEST_SUITE_P(Scenes, Resume, ::testing::Range<std::size_t>(0, courses().size()));

constexpr const char* kSmall = R"(clca: 1
seed: 3
box: {width: 40, height: 60}
species: {grain: {shape: {hexagon: 1}}}
walls: {gate: {box: [20, 0, 21, 60]}}
stages:
  - name: packing
    fill: {region: [0, 0, 20, 60], counts: {grain: 40}}
  - name: flow
    remove: [gate]
output:
  frames: {every: 10, width: 96, height: 64, color_by: displacement}
  series: {every: 1}
  checkpoint: {every: 5}
)";

class ResumeTest : public ::testing::Test {
 protected:
  scene::Scene small(const std::vector<scene::Override>& overrides = {}) const {
    return scene::parse(kSmall, "small.yaml", overrides);
  }
  fs::path path() const { return folder_.path() / "run"; }
  std::string why_not(double max_bytes = kMuch) const {
    try {
      resume(load_run(path(), max_bytes), {});
    } catch (const store::StoreError& error) {
      return error.what();
    }
    return "";
  }
  /// A run that was killed behind its last checkpoint, that of its end.
  void leave_killed() const {
    run(small(), {.folder = path()});
    fs::remove(path() / "run.json");
  }
  /// Changes the newest checkpoint and writes it back.
  template <class Change>
  void change(Change change) const {
    auto checkpoint = store::read_checkpoint(path(), kMuch)->checkpoint;
    change(checkpoint);
    store::write_checkpoint(store::OutputFolder(path()), checkpoint);
  }

  testing::ScratchFolder folder_;
};

TEST_F(ResumeTest, StoppedAtOnceOrByTimeItSavesItselfAndGoesOn) {
  const fs::path unbroken = folder_.path() / "unbroken";
  run(small(), {.folder = unbroken});
  std::atomic<int> stop = 15;
  EXPECT_EQ(run(small(), {.folder = path(), .stop_signal = &stop}).status, "interrupted");
  EXPECT_EQ(resume(load_run(path(), kMuch), {.wall_seconds_limit = 0.0}).status, "interrupted");
  EXPECT_EQ(resume(load_run(path(), kMuch), {}).status, "done");
  EXPECT_EQ(testing::difference_of_runs(unbroken, path()), "");
}

TEST_F(ResumeTest, ItGoesOnWithTheFrictionOfItsStage) {
  const auto scene = small({"model=contact", "output={checkpoint: {every: 5}}",
                            "stages.packing.contact={friction: 0, wall_friction: 0}"});
  const fs::path unbroken = folder_.path() / "unbroken";
  run(scene, {.folder = unbroken});
  std::atomic<int> stop = 0;
  run(scene, {.folder = path(), .stop_signal = &stop},
      {.progress = [&](const Progress& now) { stop = now.step >= 40 ? 2 : 0; },
       .progress_interval = {}});
  EXPECT_EQ(resume(load_run(path(), kMuch), {}).status, "done");
  EXPECT_EQ(testing::difference_of_runs(unbroken, path()), "");
}

TEST_F(ResumeTest, VelocitiesInPicturesAreMeansFromBeforeTheStop) {
  for (const char* model : {"automaton", "contact"}) {
    const auto scene = small({std::string("model=") + model, "output.frames.overlay=velocity"});
    const fs::path unbroken = folder_.path() / model;
    run(scene, {.folder = unbroken});
    std::atomic<int> stop = 0;
    run(scene, {.folder = path(), .stop_signal = &stop},
        {.progress = [&](const Progress& now) { stop = now.step >= 16 ? 2 : 0; },
         .progress_interval = {}});
    EXPECT_EQ(resume(load_run(path(), kMuch), {}).status, "done");
    EXPECT_EQ(testing::difference_of_runs(unbroken, path()), "");
  }
}

TEST_F(ResumeTest, WithoutPeriodicCheckpointsItSavesItselfWhenStopped) {
  const std::atomic<int> stop = 2;
  run(small({"output.checkpoint=none"}), {.folder = path(), .stop_signal = &stop});
  EXPECT_TRUE(fs::exists(path() / "checkpoint.clca"));
  EXPECT_EQ(resume(load_run(path(), kMuch), {}).status, "done");
  run(small({"output.checkpoint=none"}), {.folder = path()});
  EXPECT_FALSE(fs::exists(path() / "checkpoint.clca"));
}

TEST_F(ResumeTest, ARunThatIsDoneHasNothingToGoOnWith) {
  run(small(), {.folder = path()});
  EXPECT_EQ(load_run(path(), kMuch).finished_summary->status, "done");
  const auto before = testing::bytes_of(path() / "series.csv");
  resume(load_run(path(), kMuch), {});
  resume(load_run(path(), kMuch), {});
  EXPECT_EQ(testing::bytes_of(path() / "series.csv"), before);
}

TEST_F(ResumeTest, KilledBeforeTheFirstCheckpointItBeginsAnew) {
  leave_killed();
  const fs::path unbroken = folder_.path() / "unbroken";
  run(small(), {.folder = unbroken});
  change([](store::Checkpoint& checkpoint) { checkpoint.fields.clear(); });
  std::ofstream(path() / "series.csv") << "step,st";
  resume(load_run(path(), kMuch), {});
  EXPECT_EQ(testing::difference_of_runs(unbroken, path()), "");
}

TEST_F(ResumeTest, TheLogGoesOnWithoutALineTwice) {
  run(small(), {.folder = path()});
  resume(load_run(path(), kMuch), {});
  const auto bytes = testing::bytes_of(path() / "log.txt");
  const std::string log(bytes.begin(), bytes.end());
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 2) << log;
  EXPECT_THAT(log, HasSubstr("stage flow"));
}

TEST_F(ResumeTest, ADamagedCheckpointIsPassedOverForTheOneBefore) {
  leave_killed();
  const fs::path unbroken = folder_.path() / "unbroken";
  run(small(), {.folder = unbroken});
  auto bytes = testing::bytes_of(path() / "checkpoint.clca");
  bytes[bytes.size() / 2] ^= 1U;
  store::write_whole_file(path() / "checkpoint.clca", bytes);
  std::vector<std::string> warnings;
  resume(load_run(path(), kMuch), {},
         {.warning = [&](const std::string& line) { warnings.push_back(line); }});
  EXPECT_THAT(warnings,
              ::testing::ElementsAre(::testing::AllOf(
                  HasSubstr("checkpoint.clca: its checksum is wrong"),
                  EndsWith("going on from " + (path() / "checkpoint-previous.clca").string()))));
  EXPECT_EQ(testing::difference_of_runs(unbroken, path()), "");
}

TEST_F(ResumeTest, WithoutASoundCheckpointItIsRefused) {
  EXPECT_THAT(why_not(), EndsWith("run: there is no such folder"));
  fs::create_directories(path());
  EXPECT_THAT(why_not(), EndsWith("run: no run has begun there"));
  leave_killed();
  store::write_whole_file(path() / "checkpoint.clca", "clca");
  store::write_whole_file(path() / "checkpoint-previous.clca", "");
  EXPECT_THAT(why_not(), EndsWith("checkpoint.clca: it is no checkpoint of clca"));
}

TEST_F(ResumeTest, AnotherRunInTheFolderIsRefused) {
  run(small(), {.folder = path()});
  const SavedRun first = load_run(path(), kMuch);
  EXPECT_THAT(why_not(), HasSubstr("another run is at work in it"));
  EXPECT_THROW(run(small(), {.folder = path()}), store::StoreError);
}

TEST_F(ResumeTest, ACheckpointThatNeedsTooMuchMemoryIsRefused) {
  leave_killed();
  EXPECT_THAT(why_not(20'000), HasSubstr("than the limit"));
}

TEST_F(ResumeTest, AnEndThatTheRunHasPassedIsRefusedAndNothingIsChanged) {
  run(small(), {.folder = path()});
  const auto scene = testing::bytes_of(path() / "scene.yaml");
  const auto summary = testing::bytes_of(path() / "run.json");
  EXPECT_THAT([&] { resume(load_run(path(), kMuch, "2"), {}); },
              ::testing::ThrowsMessage<scene::SceneError>(
                  HasSubstr("--until 2: error: stage flow has passed this end: it is at step")));
  EXPECT_EQ(testing::bytes_of(path() / "scene.yaml"), scene);
  EXPECT_EQ(testing::bytes_of(path() / "run.json"), summary);
}

TEST_F(ResumeTest, AnEndThatTheRunHasMetBeforeIsRefusedToo) {
  run(small({"outlets={o: {region: [20, 0, 40, 20]}}", "stages.flow.until={steps: 2000}"}),
      {.folder = path()});
  for (const char* end : {"settled", "{discharged: 0.1}"}) {
    EXPECT_THAT([&] { resume(load_run(path(), kMuch, end), {}); },
                ::testing::ThrowsMessage<scene::SceneError>(HasSubstr("has passed this end")))
        << end;
  }
}

TEST_F(ResumeTest, ARunThatHasEndedAtItsBoundGoesOnToAnotherEnd) {
  const auto whole = run(small(), {.folder = folder_.path() / "whole"});
  run(small({"stages.flow.until={steps: 7}", "stages.flow.max_steps=7"}), {.folder = path()});
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(resume(load_run(path(), kMuch, "settled"), {}).state_hash, whole.state_hash);
  }
  const auto scene = std::get<scene::Scene>(load_run(path(), kMuch, "settled").scene);
  EXPECT_EQ(scene.stages.back().max_steps, 1'000'007);
}

TEST_F(ResumeTest, ARunThatHasEndedAtItsBoundGoesOnToTheSameEnd) {
  const auto whole = run(small(), {.folder = folder_.path() / "whole"});
  run(small({"stages.flow.max_steps=7"}), {.folder = path()});
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(resume(load_run(path(), kMuch, "settled"), {}).state_hash, whole.state_hash);
  }
}

TEST_F(ResumeTest, AFileThatDoesNotFitIsRefusedAndNothingIsChanged) {
  const auto files = [&] {
    std::map<fs::path, decltype(testing::bytes_of({}))> all;
    for (const auto& entry : fs::recursive_directory_iterator(path())) {
      if (entry.is_regular_file() && entry.path().filename() != "log.txt") {
        all[entry.path()] = testing::bytes_of(entry.path());
      }
    }
    return all;
  };
  for (const char* lost : {"series.csv", "trajectory/part-000000.h5"}) {
    run(small({"output.trajectory.every=5", "output.fields={}"}),
        {.folder = path(), .replace_interrupted = true});
    fs::remove(path() / lost);
    const auto before = files();
    EXPECT_THROW(resume(load_run(path(), kMuch, "5000"), {}), store::StoreError) << lost;
    EXPECT_EQ(files(), before) << lost;
  }
}

TEST_F(ResumeTest, AnInterruptedRunIsReplacedOnlyWhereThatIsAskedFor) {
  const std::atomic<int> stop = 2;
  run(small(), {.folder = path(), .stop_signal = &stop});
  run(small(), {.folder = path(), .stop_signal = &stop, .replace_interrupted = true});
  std::atomic<int> later = 0;
  run(small(), {.folder = path(), .stop_signal = &later, .replace_interrupted = true},
      {.progress = [&](const Progress&) { later = 2; }, .progress_interval = {}});
  EXPECT_THAT([&] { run(small(), {.folder = path()}); },
              ::testing::ThrowsMessage<UnfinishedRunError>(
                  ::testing::AllOf(HasSubstr("small, seed 3, interrupted"),
                                   HasSubstr("clca resume"), HasSubstr("--overwrite"))));
  EXPECT_EQ(resume(load_run(path(), kMuch), {}).status, "done");
}

TEST_F(ResumeTest, AnEndBeyondTheBoundOfStepsRaisesTheBound) {
  run(small(), {.folder = path()});  // its scene.yaml has the default
  const auto scene = std::get<scene::Scene>(load_run(path(), kMuch, "2000000").scene);
  EXPECT_EQ(scene.stages.back().max_steps, 2'000'000);
  EXPECT_EQ(std::get<scene::Scene>(load_run(path(), kMuch, "2000").scene).stages.back().max_steps,
            1'000'000);
}

TEST_F(ResumeTest, AWrongEndIsAnErrorOfTheScene) {
  run(small(), {.folder = path()});
  EXPECT_THAT([&] { load_run(path(), kMuch, "sometime"); },
              ::testing::ThrowsMessage<scene::SceneError>(
                  ::testing::StartsWith("--until sometime: error: ")));
}

TEST_F(ResumeTest, ACheckpointWithoutTheVelocitiesThatItsPicturesShowIsRefused) {
  run(small({"output.frames.overlay=velocity"}), {.folder = path()});
  fs::remove(path() / "run.json");
  change([](store::Checkpoint& checkpoint) {
    for (auto& [name, column] : checkpoint.fields) {
      if (name.starts_with("outputs/pictures/window")) {
        std::visit([](auto& numbers) { std::fill(numbers.begin(), numbers.end(), 0); }, column);
      }
    }
    std::get<std::vector<std::uint64_t>>(checkpoint.fields.at("outputs/pictures/window/size")) = {
        0};
  });
  EXPECT_THAT(why_not(), HasSubstr("checkpoint is not of this run"));
}

// Contents that no run has saved, under a right checksum.
TEST_F(ResumeTest, AHostileCheckpointIsRefused) {
  run(small(), {.folder = path()});
  const auto original = store::read_checkpoint(path(), kMuch)->checkpoint;
  const auto refusal = [&](const auto& damage) {
    auto checkpoint = original;
    damage(checkpoint);
    fs::remove(path() / "run.json");
    store::write_checkpoint(store::OutputFolder(path()), checkpoint);
    store::write_checkpoint(store::OutputFolder(path()), checkpoint);
    try {
      resume(load_run(path(), kMuch), {});
    } catch (const store::StoreError& error) {
      return std::string(error.what());
    } catch (const scene::SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto column = [](const std::string& path, auto value) {
    return [=](store::Checkpoint& checkpoint) {
      std::get<std::vector<decltype(value)>>(checkpoint.fields.at(path)).at(0) = value;
    };
  };
  const auto gone = [](const std::string& path) {
    return [=](store::Checkpoint& checkpoint) { checkpoint.fields.erase(path); };
  };
  EXPECT_EQ(refusal([](store::Checkpoint&) {}), "");
  EXPECT_THAT(refusal(gone("state/step")), EndsWith("state/step is missing"));
  EXPECT_THAT(refusal(column("state/seed", std::uint64_t{9})),
              EndsWith("the seed is not that of the scene"));
  EXPECT_THAT(refusal(column("state/particles/kind", std::uint16_t{9})),
              EndsWith("a particle is of no kind"));
  EXPECT_THAT(refusal(column("state/particles/previous", std::uint8_t{7})),
              EndsWith("the last move of a particle is out of range"));
  EXPECT_THAT(refusal(column("state/particles/column", std::int32_t{1 << 30})),
              EndsWith("a particle is too far away"));
  EXPECT_THAT(refusal(column("state/particles/row", std::int32_t{-1})),
              EndsWith("a particle leaves the box"));
  EXPECT_THAT(refusal(column("state/particles/size", std::uint64_t{1} << 40U)),
              EndsWith("state/particles needs more memory than the limit"));
  EXPECT_THAT(refusal(column("state/particles/size", std::uint64_t{39})),
              EndsWith("is too long or too short"));
  EXPECT_THAT(refusal(column("state/walls/size", std::uint64_t{0})),
              EndsWith("is too long or too short"));
  EXPECT_THAT(refusal(column("state/walls/travel/offset", std::int32_t{5})),
              EndsWith("a wall without motion has moved"));
  EXPECT_THAT(refusal(column("course/stage", std::uint64_t{2})),
              EndsWith("its stages differ from those of the scene"));
  EXPECT_THAT(refusal(column("outputs/series_bytes", std::uint64_t{1} << 40U)),
              EndsWith("it is shorter than when the checkpoint was made"));
  EXPECT_THAT(refusal([](store::Checkpoint& checkpoint) { checkpoint.scene_text = "clca: 1\n"; }),
              HasSubstr("scene.yaml:1:1: error:"));
  EXPECT_THAT(refusal([](store::Checkpoint& checkpoint) { checkpoint.summary_json = "{}"; }),
              HasSubstr("its summary"));
  EXPECT_THAT(refusal([](store::Checkpoint& checkpoint) { checkpoint.scene_name = "../../evil"; }),
              EndsWith("'../../evil' cannot name a file"));
}

}  // namespace
}  // namespace clca::run::resume_test
