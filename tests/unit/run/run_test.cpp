#include "clca/run/run.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "clca/automaton/automaton.hpp"
#include "clca/image/png.hpp"
#include "clca/model/initial_state.hpp"
#include "clca/record/quantity.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "clca/store/trajectory.hpp"
#include "support/runs.hpp"

namespace clca::run::run_test {
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
  const grains::State state = model::initial_state(small_scene());
  ASSERT_EQ(state.kinds.size(), 1U + 3U);  // the hexagon, and the rod in three directions
  EXPECT_EQ(state.kinds[3].species, 1);
}

TEST(Run, ThatFailsInALaterStageKeepsTheTrajectoryBeforeIt) {
  const scene::Scene scene = scene::parse(R"(clca: 1
box: {width: 40, height: 60}
species: {grain: {shape: {hexagon: 1}}}
stages:
  - {name: one, fill: {region: [0, 0, 40, 55], counts: {grain: 100}}}
  - {name: two, fill: {region: [0, 20, 40, 55], counts: {grain: 200}}}
output: {trajectory: {every: 10}}
)",
                                          "fails.yaml");
  const testing::ScratchFolder folder;
  EXPECT_THROW(run(scene, {.folder = folder.path() / "run"}), std::exception);
  const store::Trajectory trajectory(folder.path() / "run", scene, model::initial_state(scene),
                                     1e9);
  EXPECT_GT(trajectory.frames().size(), 1U);
}

TEST(Setup, GivesWallsTheirMotionAndLeavesOutThoseThatComeLater) {
  const grains::State state = model::initial_state(small_scene(
      {"walls={plate: {box: [1, 70, 9, 74], motion: {direction: down, distance: 30}, passive: "
       "overlap}, post: {box: [2, 0, 4, 3]}}",
       "stages=[{name: first, fill: {region: [10, 0, 20, 40], counts: {small: 1, rod: 1}}}, {name: "
       "second, insert: [plate], move: [plate]}]"}));
  ASSERT_EQ(state.walls.size(), 2U);
  EXPECT_FALSE(state.walls[0].present);
  EXPECT_EQ(state.walls[0].motion,
            (grains::WallMotion{lattice::Direction::down, grains::Drive{1, 30}}));
  EXPECT_EQ(state.walls[0].passive_rule, grains::PassiveRule::overlap);
  EXPECT_FALSE(state.walls[0].sites.empty()) << "outside the box at home";
  EXPECT_TRUE(state.walls[1].present);
  EXPECT_FALSE(state.walls[1].motion.has_value());
}

TEST(Setup, WhereTheCoordinatesOfAShapeStartDoesNotMatter) {
  const auto near = small_scene({"species.rod.shape={sites: [[0, 0], [1, 0], [2, 0]]}"});
  const auto far = small_scene({"species.rod.shape={sites: [[90, 7], [91, 7], [92, 7]]}"});
  EXPECT_EQ(model::initial_state(near).kinds, model::initial_state(far).kinds);
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

TEST(Run, DerivesMeasuresFromOthersAndSaysWhatTheyAre) {
  const testing::ScratchFolder folder;
  const auto summary = run(small_scene({"measure={ratio: {value: =runout_99 / 30, about: Reach}, "
                                        "twice: =2*ratio, rate: =ratio / steps, "
                                        "none: =repose_left_deg + 1}"}),
                           {.folder = folder.path() / "out"});
  const auto& measures = summary.stages.at(1).measures;
  const auto value = [&](const std::string& name) {
    const auto found = std::ranges::find(measures, name, &store::NamedMeasure::first);
    const auto* number = found == measures.end() ? nullptr : std::get_if<double>(&found->second);
    return number != nullptr ? *number : std::nan("");
  };
  EXPECT_GT(value("runout_99"), 0);
  EXPECT_EQ(value("ratio"), value("runout_99") / 30);
  EXPECT_EQ(value("twice"), 2 * value("ratio"));
  EXPECT_EQ(value("rate"), value("ratio") / static_cast<double>(summary.stages[1].steps));
  EXPECT_EQ(measures.back(), store::NamedMeasure("none", {})) << "the heap has no left flank";
  const auto read = store::read_summary(folder.path() / "out" / "run.json");
  EXPECT_TRUE(std::ranges::equal(read.derived_measures, summary.derived_measures, {},
                                 &scene::DerivedMeasure::expression,
                                 &scene::DerivedMeasure::expression));
  EXPECT_EQ(read.stages[1].measures, measures);
  const record::KnownQuantities known = record::known_quantities(read);
  EXPECT_EQ(known.find("ratio")->name, "Reach");
  EXPECT_EQ(known.find("twice")->meaning, "=2*ratio");
  EXPECT_EQ(known.find("runout_99")->name, "Run-out of 99 %");
}

TEST(Run, RefusesDerivedMeasuresOfNamesThatThereAreNot) {
  const auto expect = [](const std::string& measure, const std::string& message) {
    EXPECT_THAT([&] { record::check_derived(small_scene({"measure=" + measure})); },
                ::testing::ThrowsMessage<scene::SceneError>(::testing::EndsWith(message)));
  };
  expect("{ratio: =runout_9 / 3}",
         "error: measure.ratio: unknown measure 'runout_9' in '=runout_9 / 3'; did you mean "
         "'runout_99'?");
  expect("[packing, {ratio: =runout_99 / 3}]",
         "error: measure.ratio: unknown measure 'runout_99' in '=runout_99 / 3'; it comes with "
         "runout, so name that under measure, too");
  expect("{ratio: =later, later: =steps}",
         "error: measure.ratio: unknown measure 'later' in '=later'");
  expect("{runout_99: =steps}",
         "error: measure.runout_99: there is a quantity of this name; give it another one");
  expect("{ratio: =discharged.drain}",
         "error: measure.ratio: unknown measure 'discharged.drain' in '=discharged.drain'; did you "
         "mean 'discharged_share'?");
  EXPECT_NO_THROW(record::check_derived(small_scene(
      {"outlets={drain: {region: [40, 0, 50, 5]}}", "measure={ratio: =discharged.drain + time}"})));
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
  EXPECT_EQ(png.text.at("Software"), "clca " + store::version());
}

TEST(Run, AFillThatDoesNotFitSaysHowManyFittedAndMakesNoFolder) {
  const testing::ScratchFolder folder;
  const auto scene = small_scene({"stages.packing.fill.counts.small=285"});
  EXPECT_THAT([&] { run(scene, {.folder = folder.path() / "out"}); },
              ::testing::ThrowsMessage<scene::SceneError>(::testing::AllOf(
                  ::testing::StartsWith("small.yaml:12:11: error: the fill of stage packing"),
                  ::testing::HasSubstr("of 285 small"), ::testing::HasSubstr("enlarge"))));
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(Run, StopsWhenAskedWithEverythingWritten) {
  const testing::ScratchFolder folder;
  std::atomic<int> stop = 2;
  const auto summary = run(small_scene(), {.folder = folder.path(), .stop_signal = &stop});
  EXPECT_EQ(summary.status, "interrupted");
  EXPECT_EQ(json_of(folder.path() / "run.json")["status"], "interrupted");
}

TEST(Run, EndsAStageAtItsBoundWithAWarning) {
  const testing::ScratchFolder folder;
  std::vector<std::string> warnings;
  const auto summary = run(small_scene({"stages.packing.max_steps=7"}), {.folder = folder.path()},
                           {.warning = [&](const std::string& text) { warnings.push_back(text); }});
  EXPECT_EQ(summary.stages[0].steps, 7U);
  EXPECT_EQ(summary.stages[0].end_reason, "bound");
  EXPECT_THAT(warnings, ::testing::Contains(::testing::HasSubstr("stage packing")));
}

TEST(Run, RunsAStageForAGivenNumberOfSteps) {
  const testing::ScratchFolder folder;
  const auto summary =
      run(small_scene({"stages.packing.until={steps: 33}"}), {.folder = folder.path()});
  EXPECT_EQ(summary.stages[0].steps, 33U);
  EXPECT_EQ(summary.stages[0].end_reason, "steps");
}

const std::vector<scene::Override> kTwoDrains = {
    "output={series: {every: 1}}",
    "outlets={left: {region: [0, 0, 15, 10]}, right: {region: [31, 0, 60, 10]}}"};

TEST(Run, SaysHowMuchHasLeftIfAStageComesToRestBefore) {
  const testing::ScratchFolder folder;
  std::vector<scene::Override> overrides = kTwoDrains;
  overrides.emplace_back("stages.flow.until={discharged: 1}");
  const auto summary = run(small_scene(overrides), {.folder = folder.path()});
  ASSERT_EQ(summary.stages.back().end_reason, "settled");
  const double share = testing::measure_of(summary, "flow", "discharged_share");
  const auto log = testing::bytes_of(folder.path() / "log.txt");
  EXPECT_THAT(
      std::string(log.begin(), log.end()),
      ::testing::HasSubstr(fmt::format(
          "stage flow: nothing moves any more, with {:.3g} % discharged, not 100 %", 100 * share)));
}

TEST(Run, CountsWhatLeavesByOutletAndSpecies) {
  const testing::ScratchFolder folder;
  const auto summary = run(small_scene(kTwoDrains), {.folder = folder.path()});
  const auto column = [&](const std::string& name) {
    return testing::csv_column(folder.path() / "series.csv", name);
  };
  const std::vector<double> left = column("discharged.left");
  const std::vector<double> right = column("discharged.right");
  const std::vector<double> all = column("discharged_particles");
  EXPECT_GT(left.back(), 0);
  EXPECT_GT(right.back(), 0);
  for (std::size_t row = 0; row < all.size(); ++row) {
    EXPECT_EQ(left[row] + right[row], all[row]);
  }
  EXPECT_EQ(column("discharged.left.small").back() + column("discharged.left.rod").back(),
            left.back());
  EXPECT_EQ(testing::measure_of(summary, "packing", "discharged.right"), 0);
  EXPECT_EQ(testing::measure_of(summary, "flow", "discharged.right"), right.back());
  EXPECT_EQ(testing::measure_of(summary, "packing", "discharged.left") +
                testing::measure_of(summary, "flow", "discharged.left"),
            left.back());
  EXPECT_GT(left.front(), 0);  // what the fill has put into it belongs to its stage
  EXPECT_GT(testing::measure_of(summary, "packing", "outflow_sites_per_step.left"), 0);
  EXPECT_EQ(testing::measure_of(summary, "packing", "outflow_sites_per_step.right"), 0);
  const auto json = json_of(folder.path() / "run.json");
  EXPECT_EQ(json["stages"][1]["measures"]["clogged.right"], false);
}

TEST(Run, OneOutletAndOneSpeciesAreNotCountedApart) {
  const testing::ScratchFolder folder;
  std::vector<scene::Override> one = kTwoDrains;
  one.emplace_back("outlets={left: {region: [0, 0, 15, 10]}}");
  one.emplace_back("species={small: {shape: {hexagon: 1}}}");
  one.emplace_back("stages.packing.fill.counts={small: 30}");
  run(small_scene(one), {.folder = folder.path()});
  const store::ParsedTable table = store::read_table(folder.path() / "series.csv");
  EXPECT_EQ(table.column_names.back(), "discharged_sites");
}

TEST(Run, AProbeAcrossTheBoxCountsWhatTheOutletBelowItCounts) {
  const testing::ScratchFolder folder;
  run(small_scene({"output={series: {every: 7}}", "walls={}",
                   "outlets={all: {region: [0, 0, 60, 15]}}",
                   "probes={line: [0, 20, 60, 30], side: [50, 0, 60, 60]}",
                   "stages=[{name: fall, fill: {region: [0, 30, 30, 60], counts: {small: 20, rod: "
                   "20}}}]"}),
      {.folder = folder.path()});
  const store::ParsedTable table = store::read_table(folder.path() / "probes.csv");
  EXPECT_EQ(table.column_names,
            (std::vector<std::string>{"step", "stage", "probe", "filling", "particles", "vx", "vy",
                                      "fluctuation", "flow"}));
  EXPECT_EQ(table.find_column("vy")->at(0), "");  // nothing came before
  EXPECT_EQ(table.find_column("flow")->at(0), "");
  EXPECT_LT(std::stod(table.find_column("vy")->at(4)), -0.9);  // of the line: all rain down
  const std::vector<double> steps = testing::csv_column(folder.path() / "probes.csv", "step");
  double passed = 0;
  for (std::size_t row = 2; row < steps.size(); row += 2) {
    EXPECT_EQ(table.find_column("probe")->at(row), "line");
    passed += std::stod(table.find_column("flow")->at(row)) * (steps[row] - steps[row - 2]);
  }
  EXPECT_NEAR(passed, 20 * 7 + 20 * 3, 1e-9);
  EXPECT_EQ(testing::csv_column(folder.path() / "series.csv", "discharged_sites").back(), 200);
}

TEST(Run, ALineAcrossTheBoxCountsWhatTheOutletBelowItCounts) {
  for (const char* kind : {"model=automaton", "model=contact", "box.periodic=true"}) {
    const testing::ScratchFolder folder;
    run(small_scene(
            {kind, "output={series: {every: 7}}", "walls={}", "species.rod.shape={hexagon: 2}",
             "species.rod.orientations=[0]", "outlets={all: {region: [0, 0, 60, 15]}}",
             "lines={line: {from: [0, 20], to: [60, 20], parts: 7}, side: {from: [1, 50], "
             "to: [1, 15]}}",
             "stages=[{name: fall, fill: {region: [0, 30, 30, 60], counts: {small: 20, rod: "
             "9}}, until: {steps: 2000}}]"}),
        {.folder = folder.path()});
    const fs::path file = folder.path() / "lines-fall.csv";
    const store::ParsedTable table = store::read_table(file);
    EXPECT_EQ(
        table.column_names,
        (std::vector<std::string>{"line", "position", "x", "y", "flux", "flux_se", "v_across",
                                  "v_across_se", "v_along", "v_along_se", "filling", "particles"}));
    ASSERT_EQ(table.row_count(), 7U + 20U);
    EXPECT_EQ(table.find_column("line")->at(6), "line");
    EXPECT_EQ(table.find_column("line")->at(7), "side");
    const std::vector<double> flux = table.column_numbers("flux");
    const double passed = std::accumulate(flux.begin(), flux.begin() + 7, 0.0) * 2000 * 60 / 7;
    EXPECT_NEAR(passed,
                testing::csv_column(folder.path() / "series.csv", "discharged_sites").back(), 1e-9)
        << kind;
    EXPECT_GT(table.column_numbers("v_across")[0], 0);
  }
}

TEST(Run, WithoutASeriesNothingObservesLines) {
  const testing::ScratchFolder folder;
  scene::Scene scene = small_scene({"lines={line: {from: [0, 20], to: [60, 20]}}"});
  scene.output = {};
  run(scene, {.folder = folder.path()});
  EXPECT_FALSE(fs::exists(folder.path() / "lines-flow.csv"));
}

TEST(Run, DrawsTheFinalStateAloneWhenAskedAndIsTheSameRun) {
  const testing::ScratchFolder folder;
  const auto course = run(small_scene(), {.folder = folder.path() / "course"});
  const auto last =
      run(small_scene(), {.folder = folder.path() / "last", .pictures = WantedPictures::last});
  EXPECT_EQ(last.state_hash, course.state_hash);
  const fs::path frames = folder.path() / "last" / "frames";
  ASSERT_EQ(std::distance(fs::directory_iterator(frames), fs::directory_iterator()), 1);
  EXPECT_EQ(fs::directory_iterator(frames)->path(),
            store::frame_path(folder.path() / "last", "small", last.steps, 6));
}

TEST(Run, AFolderThatCannotBeWrittenIsAnErrorWithItsPath) {
  const testing::ScratchFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  EXPECT_THAT([&] { run(small_scene(), {.folder = folder.path() / "file" / "out"}); },
              ::testing::ThrowsMessage<store::StoreError>(::testing::HasSubstr("file/out")));
}

}  // namespace
}  // namespace clca::run::run_test
