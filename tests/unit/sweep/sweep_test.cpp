#include "clca/sweep/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "clca/image/png.hpp"
#include "clca/run/run.hpp"
#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"
#include "support/runs.hpp"
#include "support/thread_ranks.hpp"

namespace clca::sweep::sweep_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr const char* kSmallScene = R"(clca: 1
box: {width: 40, height: 40}
species:
  small: {shape: {hexagon: 1}}
walls:
  gate: {box: [20, 0, 21, 40]}
stages:
  - name: packing
    fill: {region: [0, 0, 20, 40], counts: {small: 12}}
  - name: flow
    remove: [gate]
output:
  frames: {every: 10, width: 64, height: 48, caption: false}
  series: {every: 1}
)";

class SweepTest : public ::testing::Test {
 protected:
  void SetUp() override { std::ofstream(file()) << kSmallScene; }

  fs::path file() const { return folder_.path() / "small.yaml"; }
  fs::path at(const std::string& path) const { return folder_.path() / path; }
  std::string text(const std::string& path) const {
    const auto bytes = testing::bytes_of(at(path));
    return {bytes.begin(), bytes.end()};
  }
  Plan plan_of(const std::string& variation = "rules.inertia=0,0.9") const {
    return plan({.scene_file = file(),
                 .overrides = {},
                 .variations = {parse_variation(variation)},
                 .seeds = {1, 2, 5}});
  }
  Progress run(const Plan& plan, const std::string& folder, int jobs = 2, bool all = false) {
    warnings_.clear();
    return execute(plan, {.folder = at(folder), .jobs = jobs, .all_pictures = all},
                   {.warning = [this](const std::string& line) { warnings_.push_back(line); }});
  }
  std::size_t picture_count(const std::string& run) const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(at(run) / "frames"), fs::directory_iterator()));
  }

  testing::ScratchFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(SweepTest, LeavesARunFolderForEachRunAndTablesOverAll) {
  const Progress totals = run(plan_of(), "out");
  EXPECT_EQ(totals.done_runs, 6U);
  EXPECT_EQ(totals.reused_runs, 0U);
  const auto json = nlohmann::json::parse(text("out/sweep.json"));
  EXPECT_EQ(json["seeds"], "1..2,5");
  EXPECT_EQ(json["title"], plan_of().variants.front().scene.title);
  EXPECT_EQ(json["vary"][0]["rows"][1][0], "0.9");
  const auto& columns = json["tables"]["mean-series"];
  const auto error = std::ranges::find(columns, "mean_height_se",
                                       [](const auto& column) { return column["key"]; });
  ASSERT_NE(error, columns.end());
  EXPECT_EQ((*error)["unit"], "spacings") << "of the mean";
  const auto scene = scene::parse_file(at("out/runs/rules.inertia=0.9,seed=5/scene.yaml"));
  EXPECT_EQ(scene.seed, 5U);
  EXPECT_EQ(testing::csv_column(at("out/runs.csv"), "seed"),
            (std::vector<double>{1, 2, 5, 1, 2, 5}));
  EXPECT_THAT(text("out/measures.csv"),
              AllOf(HasSubstr("\n0,flow,steps,"), HasSubstr("\n0.9,packing,packing_fraction,")));
}

TEST_F(SweepTest, MeansOverTheSeedsComeWithTheTablesAndGoWithWhatTheyAreOf) {
  run(plan_of(), "out");
  const auto heights = testing::csv_column(at("out/mean-series.csv"), "mean_height");
  double mean = 0;
  for (const char* seed : {"1", "2", "5"}) {
    mean +=
        testing::csv_column(at("out/runs/rules.inertia=0,seed=" + std::string(seed)) / "series.csv",
                            "mean_height")
            .at(7) /
        3;
  }
  EXPECT_NEAR(heights.at(7), mean, 1e-12);
  EXPECT_THAT(text("out/mean-profile-flow.csv"),
              HasSubstr("rules.inertia,x,runs,height_start,height_start_se,height_end,"));
  std::ofstream(at("out/mean-mine.csv")) << "x\n";
  std::ofstream(file(), std::ios::app) << "measure: []\n";
  run(plan_of(), "out");
  EXPECT_TRUE(fs::exists(at("out/mean-series.csv")));
  EXPECT_FALSE(fs::exists(at("out/mean-profile-flow.csv")));
  EXPECT_TRUE(fs::exists(at("out/mean-mine.csv")));
}

TEST_F(SweepTest, ARunOfASweepIsTheSameAsTheRunAlone) {
  run(plan_of(), "out");
  const auto alone = run::run(plan_of().scene(3), {.folder = at("alone")});
  EXPECT_THAT(
      text("out/runs.csv"),
      HasSubstr(nlohmann::json::parse(text("alone/run.json"))["state_hash"].get<std::string>()));
  EXPECT_EQ(text("alone/series.csv"), text("out/runs/rules.inertia=0.9,seed=1/series.csv"));
}

TEST_F(SweepTest, TablesAndOverviewDoNotDependOnTheNumberOfJobs) {
  run(plan_of(), "one", 1);
  run(plan_of(), "four", 4);
  for (const std::string file : {"runs.csv", "measures.csv", "overview.png", "sweep.json"}) {
    EXPECT_EQ(text("one/" + file), text("four/" + file)) << file;
  }
}

TEST_F(SweepTest, PartsAtTheSameTimeLeaveTheRunsOfAllOfIt) {
  const Plan plan = plan_of();
  run(plan, "all");
  std::vector<std::thread> processes;
  for (const std::size_t number : {1U, 2U, 3U, 4U}) {
    processes.emplace_back([&, number] {
      const Progress part =
          execute(plan, {.folder = at("parts"), .part = Part{.number = number, .count = 4}}, {});
      EXPECT_EQ(part.total_runs, number <= 2 ? 2U : 1U);  // of six
      EXPECT_EQ(part.done_runs, part.total_runs);
    });
  }
  for (std::thread& process : processes) {
    process.join();
  }
  EXPECT_FALSE(fs::exists(at("parts/runs.csv")));
  EXPECT_FALSE(fs::exists(at("parts/sweep.json")));
  EXPECT_EQ(run(plan, "parts").reused_runs, 6U);
  for (const char* name : {"runs.csv", "measures.csv", "overview.png", "sweep.json"}) {
    EXPECT_EQ(text(std::string("parts/") + name), text(std::string("all/") + name)) << name;
  }
}

TEST_F(SweepTest, GoesOnWhereItWasAndRunsOnlyWhatIsNotWhole) {
  run(plan_of(), "out");
  const std::string runs = text("out/runs.csv");
  const std::string measures = text("out/measures.csv");
  const std::string overview = text("out/overview.png");
  const fs::path kept = at("out/runs/rules.inertia=0.9,seed=2/run.json");
  const auto before = fs::last_write_time(kept);
  fs::remove_all(at("out/runs/rules.inertia=0,seed=1"));
  const fs::path cut = at("out/runs/rules.inertia=0,seed=2/run.json");
  fs::resize_file(cut, fs::file_size(cut) / 2);
  std::ofstream(at("out/runs/rules.inertia=0,seed=5/scene.yaml"), std::ios::app) << "# changed\n";
  fs::remove_all(at("out/runs/rules.inertia=0.9,seed=1/frames"));
  const Progress totals = run(plan_of(), "out");
  EXPECT_EQ(totals.done_runs, 6U);
  EXPECT_EQ(totals.reused_runs, 2U);
  EXPECT_EQ(fs::last_write_time(kept), before);
  EXPECT_EQ(text("out/runs.csv"), runs);
  EXPECT_EQ(text("out/measures.csv"), measures);
  EXPECT_EQ(text("out/overview.png"), overview);
}

TEST_F(SweepTest, AnotherSweepInTheFolderTakesTheRunsThatAreTheSameAndLeavesTheRest) {
  run(plan_of(), "out");
  store::write_whole_file(at("out/notes.txt"), "mine");
  const Progress totals = run(plan_of("rules.inertia=0.9,0.5"), "out");
  EXPECT_EQ(totals.reused_runs, 3U);
  EXPECT_EQ(testing::csv_column(at("out/runs.csv"), "rules.inertia"),
            (std::vector<double>{0.9, 0.9, 0.9, 0.5, 0.5, 0.5}));
  EXPECT_TRUE(fs::exists(at("out/notes.txt")));
  EXPECT_TRUE(fs::exists(at("out/runs/rules.inertia=0,seed=1/run.json")));
}

TEST_F(SweepTest, RunsBeginWithOnePackingAndAreDoneAnewForAnother) {
  const auto pack = [&](const std::string& seed) {
    run::run(scene::parse_file(file(), {"seed=" + seed,
                                        "stages=[{name: packing, fill: {region: "
                                        "[0, 0, 20, 40], counts: {small: 12}}}]"}),
             {.folder = at("packing")});
  };
  const auto gates = [&] {
    return plan({.scene_file = file(),
                 .overrides = {"begin={run: packing}", "stages=[{name: flow, remove: [gate]}]"},
                 .variations = {parse_variation("rules.inertia=0,0.9")},
                 .seeds = {1, 2}});
  };
  pack("1");
  EXPECT_EQ(run(gates(), "out").done_runs, 4U);
  const auto json = nlohmann::json::parse(text("out/runs/rules.inertia=0,seed=2/run.json"));
  EXPECT_EQ(json["begin"]["run"], at("packing").string());
  EXPECT_EQ(json["particles"], 12);
  EXPECT_EQ(run(gates(), "out").reused_runs, 4U);
  pack("2");
  EXPECT_EQ(run(gates(), "out").reused_runs, 0U);
}

TEST_F(SweepTest, ARunThatFailsIsNamedAndTheOthersGoOn) {
  const Progress totals = run(plan_of("stages.packing.fill.counts.small=136,12"), "out");
  EXPECT_EQ(totals.failed_runs, 3U);
  EXPECT_EQ(totals.done_runs, 3U);
  EXPECT_THAT(warnings_,
              AllOf(SizeIs(3), Contains(AllOf(HasSubstr("counts.small=136,seed=5 failed"),
                                              HasSubstr("of 136 small fitted")))));
  EXPECT_THAT(text("out/runs.csv"), HasSubstr("136,1,failed,"));
  const auto overview = image::decode_png(testing::bytes_of(at("out/overview.png"))).image;
  EXPECT_GT(overview.width, 0);
}

TEST_F(SweepTest, DrawsTheFinalStateOnlyUnlessAllPicturesAreAskedFor) {
  run(plan_of(), "out");
  EXPECT_EQ(picture_count("out/runs/rules.inertia=0,seed=1"), 1U);
  EXPECT_EQ(run(plan_of(), "out", 2, true).reused_runs, 0U);
  EXPECT_GT(picture_count("out/runs/rules.inertia=0,seed=1"), 2U);
  EXPECT_EQ(run(plan_of(), "out").reused_runs, 6U);
}

TEST_F(SweepTest, WithoutPicturesThereIsNoOverviewNotEvenAnOldOne) {
  run(plan_of(), "out");
  Plan plain = plan_of();
  for (Variant& variant : plain.variants) {
    variant.scene.output.frames.reset();
  }
  run(plain, "out");
  EXPECT_FALSE(fs::exists(at("out/overview.png")));
}

TEST_F(SweepTest, ShowsHowFarTheRunsAreThatAreUnderWay) {
  const Plan plan = plan_of("stages.packing.until={steps: 100000000}");
  std::atomic<int> stop = 0;
  std::optional<RunUnderWay> seen;
  const Progress last = execute(plan, {.folder = at("out"), .jobs = 2, .stop_signal = &stop},
                                {.progress = [&](const Progress& now) {
                                  if (!now.running.empty()) {
                                    seen = now.running.front();
                                    stop = 2;
                                  }
                                }});
  ASSERT_TRUE(seen);
  EXPECT_TRUE(seen->name == plan.run_name(0) || seen->name == plan.run_name(1)) << seen->name;
  EXPECT_EQ(seen->progress.stage, "packing");
  EXPECT_GT(seen->progress.step, 0U);
  EXPECT_TRUE(last.running.empty());
}

TEST_F(SweepTest, StopsWhenAskedAndGoesOnLater) {
  std::atomic<int> stop = 0;
  const auto count_down = [&](const Progress& progress) { stop = progress.done_runs > 0 ? 2 : 0; };
  const Plan plan = plan_of();
  const Progress first = execute(plan, {.folder = at("out"), .jobs = 1, .stop_signal = &stop},
                                 {.progress = count_down});
  EXPECT_GE(first.done_runs, 1U);
  EXPECT_TRUE(fs::exists(at("out/runs.csv")));
  EXPECT_EQ(run(plan, "out").done_runs, 6U);
  run(plan, "whole");
  EXPECT_EQ(text("out/runs.csv"), text("whole/runs.csv"));
}

TEST_F(SweepTest, ARunThatWasStoppedGoesOnWhereItWas) {
  const Plan plan = plan_of();
  run(plan, "whole");
  const std::string name = "runs/rules.inertia=0,seed=2/";
  std::atomic<int> stop = 0;
  run::run(
      plan.scene(1),
      {.folder = at("out/" + name), .stop_signal = &stop, .pictures = run::WantedPictures::last},
      {.detail = [&](const std::string& text) { stop = text.starts_with("stage flow") ? 2 : 0; }});
  ASSERT_THAT(text("out/" + name + "run.json"), HasSubstr("\"interrupted\""));
  const std::string packed = text("out/" + name + "log.txt");
  EXPECT_EQ(run(plan, "out").done_runs, 6U);
  // The line of the first stage, with its time.
  EXPECT_THAT(text("out/" + name + "log.txt"),
              ::testing::StartsWith(packed.substr(0, packed.find('\n') + 1)));
  EXPECT_EQ(text("out/" + name + "series.csv"), text("whole/" + name + "series.csv"));
  for (const char* file : {"runs.csv", "measures.csv", "overview.png"}) {
    EXPECT_EQ(text(std::string("out/") + file), text(std::string("whole/") + file)) << file;
  }
}

TEST_F(SweepTest, ARunThatWasStoppedWithoutAPictureThatIsWantedNowIsDoneAnew) {
  const Plan plan = plan_of();
  std::atomic<int> stop = 0;
  run::run(
      plan.scene(1),
      {.folder = at("out/runs/rules.inertia=0,seed=2"),
       .stop_signal = &stop,
       .pictures = run::WantedPictures::none},
      {.detail = [&](const std::string& text) { stop = text.starts_with("stage flow") ? 2 : 0; }});
  EXPECT_EQ(run(plan, "out").done_runs, 6U);
  EXPECT_EQ(picture_count("out/runs/rules.inertia=0,seed=2"), 1U);
}

TEST_F(SweepTest, ARunThatFailedForWantOfSpaceGoesOnAndADamagedOneBeginsAnew) {
  const Plan plan = plan_of();
  run(plan, "whole");
  const std::string name = "out/runs/rules.inertia=0,seed=2/";
  const auto stopped_run = [&] {
    std::atomic<int> stop = 0;
    run::run(plan.scene(1),
             {.folder = at(name), .stop_signal = &stop, .pictures = run::WantedPictures::last},
             {.detail = [&](const std::string& text) {
               stop = text.starts_with("stage flow") ? 2 : 0;
             }});
    auto json = nlohmann::ordered_json::parse(text(name + "run.json"));
    json["status"] = "failed";
    store::write_whole_file(at(name + "run.json"), json.dump(2) + "\n");
    return text(name + "log.txt");
  };
  const std::string log = stopped_run();
  EXPECT_EQ(run(plan, "out").done_runs, 6U);
  EXPECT_THAT(text(name + "log.txt"), ::testing::StartsWith(log.substr(0, log.find('\n') + 1)));
  EXPECT_THAT(warnings_, ::testing::IsEmpty());

  fs::remove_all(at("out"));
  stopped_run();
  fs::resize_file(at(name + "series.csv"), 5);
  EXPECT_EQ(run(plan, "out").done_runs, 6U);
  EXPECT_THAT(warnings_, ::testing::ElementsAre(HasSubstr("begins anew")));
  EXPECT_EQ(text("out/runs.csv"), text("whole/runs.csv"));
}

TEST_F(SweepTest, OtherRanksDoAShareAndTheTablesAreTheSame) {
  const Plan plan = plan_of("rules.inertia=0,0.5,0.9");
  run(plan, "one");
  testing::ThreadRanks all(3);
  std::vector<std::thread> others;
  for (const int number : {1, 2}) {
    others.emplace_back([&, number] {
      const auto ranks = all.seen_from(number);
      work_for_rank_0(plan, {.folder = at("ranks"), .ranks = ranks.get()});
    });
  }
  const auto ranks = all.seen_from(0);
  std::vector<std::string> messages;
  const Progress totals =
      execute(plan, {.folder = at("ranks"), .ranks = ranks.get()},
              {.message = [&](const std::string& line) { messages.push_back(line); }});
  EXPECT_EQ(totals.done_runs, 9U);
  ranks->dismiss();
  for (std::thread& other : others) {
    other.join();
  }
  EXPECT_GT(all.received_by_first(), 4U);  // their begins and ends, and what they have done
  EXPECT_THAT(messages, ::testing::ElementsAre(
                            ::testing::MatchesRegex("3 ranks, with [0-9] to [1-9] runs each")));
  for (const char* name : {"runs.csv", "measures.csv", "overview.png", "sweep.json"}) {
    EXPECT_EQ(text(std::string("ranks/") + name), text(std::string("one/") + name)) << name;
  }
}

TEST_F(SweepTest, FailuresAndWarningsOfOtherRanksAreToldAsThoseOfThisOne) {
  const Plan plan = plan_of("stages.packing.fill.counts.small=136,12");
  run(plan, "one");
  testing::ThreadRanks all(2);
  std::thread other([&] {
    const auto ranks = all.seen_from(1);
    work_for_rank_0(plan, {.folder = at("ranks"), .jobs = 8, .ranks = ranks.get()});
  });
  const auto ranks = all.seen_from(0);
  std::vector<std::string> warnings;
  const Progress totals =
      execute(plan, {.folder = at("ranks"), .ranks = ranks.get()},
              {.warning = [&](const std::string& line) { warnings.push_back(line); }});
  ranks->dismiss();
  other.join();
  EXPECT_EQ(totals.failed_runs, 3U);
  EXPECT_THAT(warnings, ::testing::UnorderedElementsAreArray(warnings_));
  EXPECT_EQ(text("ranks/runs.csv"), text("one/runs.csv"));
}

TEST_F(SweepTest, TheLongestComeFirstWhereEarlierRunsTell) {
  const auto of_seeds = [this](std::vector<std::uint64_t> seeds) {
    return plan({.scene_file = file(),
                 .overrides = {},
                 .variations = {parse_variation("rules.inertia=0,0.5,0.9")},
                 .seeds = std::move(seeds)});
  };
  run(of_seeds({1}), "out");
  const auto tell = [&](const std::string& value, const std::string& seconds) {
    const std::string file = "out/runs/rules.inertia=" + value + ",seed=1/run.json";
    auto json = nlohmann::ordered_json::parse(text(file));
    json["wall_seconds"] = std::stod(seconds);
    store::write_whole_file(at(file), json.dump(2) + "\n");
  };
  tell("0", "2");
  tell("0.5", "30");
  tell("0.9", "7");
  for (const char* value : {"0.5", "0.9", "0"}) {
    std::atomic<int> stop = 0;
    const auto after_one = [&](const Progress& now) {
      stop = now.done_runs > now.reused_runs ? 2 : 0;
    };
    execute(of_seeds({1, 2}), {.folder = at("out"), .stop_signal = &stop}, {.progress = after_one});
    const std::string first = "out/runs/rules.inertia=" + std::string(value) + ",seed=2/run.json";
    ASSERT_TRUE(fs::exists(at(first))) << value;
    EXPECT_THAT(text(first), HasSubstr("\"done\"")) << value;
  }
}

TEST_F(SweepTest, ARunThatIsUnderWayElsewhereIsLeftToTheOtherProcess) {
  const fs::path taken = at("out/runs/rules.inertia=0.9,seed=2");
  fs::create_directories(taken);
  {
    const store::FolderLock other(taken);
    const Progress totals = run(plan_of(), "out");
    EXPECT_EQ(totals.done_runs, 5U);
    EXPECT_EQ(totals.runs_elsewhere, 1U);
    EXPECT_THAT(text("out/runs.csv"), HasSubstr("0.9,2,waiting,"));
  }
  EXPECT_EQ(run(plan_of(), "out").done_runs, 6U);
}

TEST_F(SweepTest, OneSweepAtATimeWritesTheTables) {
  run(plan_of(), "out");
  const store::FolderLock other(at("out"));
  EXPECT_THROW(run(plan_of(), "out"), store::FolderInUseError);
}

TEST_F(SweepTest, CollectsWithoutRunning) {
  execute(plan_of(), {.folder = at("out"), .part = Part{.number = 1, .count = 2}}, {});
  const Progress totals = execute(plan_of(), {.folder = at("out"), .collect_only = true}, {});
  EXPECT_EQ(totals.done_runs, 3U);
  EXPECT_EQ(totals.total_runs, 6U);
  EXPECT_THAT(text("out/runs.csv"), AllOf(HasSubstr("0,1,done,"), HasSubstr("0,2,waiting,")));
  EXPECT_FALSE(fs::exists(at("out/runs/rules.inertia=0,seed=2")));
}

TEST_F(SweepTest, DrawsNoPicturesThatTheOverviewDoesNotShow) {
  Plan many = plan_of();
  many.request.seeds = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  run(many, "out");
  EXPECT_EQ(picture_count("out/runs/rules.inertia=0,seed=8"), 1U);
  EXPECT_FALSE(fs::exists(at("out/runs/rules.inertia=0,seed=9/frames")));
  EXPECT_EQ(run(many, "out").reused_runs, 18U);
}

TEST_F(SweepTest, WhatCannotBeWrittenEndsTheSweepWithItsPath) {
  store::write_whole_file(at("file"), "x");
  EXPECT_THAT([&] { run(plan_of(), "file"); },
              ::testing::ThrowsMessage<store::StoreError>(HasSubstr("file: Not a directory")));
  fs::create_directories(at("out/runs"));
  store::write_whole_file(at("out/runs/rules.inertia=0,seed=2"), "x");
  EXPECT_THAT([&] { run(plan_of(), "out"); },
              ::testing::ThrowsMessage<store::StoreError>(HasSubstr("seed=2")));
}

TEST_F(SweepTest, EightRunsAtOnceDoNotDisturbEachOther) {
  Plan many = plan_of();
  many.request.seeds.resize(24);
  std::iota(many.request.seeds.begin(), many.request.seeds.end(), 1U);
  EXPECT_EQ(run(many, "eight", 8, true).done_runs, 48U);
  run(many, "one", 1, true);
  EXPECT_EQ(text("eight/runs.csv"), text("one/runs.csv"));
  EXPECT_EQ(text("eight/overview.png"), text("one/overview.png"));
}

}  // namespace
}  // namespace clca::sweep::sweep_test
