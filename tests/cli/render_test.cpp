// clca render as a user meets it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "clca/image/png.hpp"
#include "clca/process/program.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "support/missing.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"
#include "support/sanitizers.hpp"
#include "support/stored_run.hpp"

namespace clca::render_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kScene = R"(clca: 1
title: Small
box: {width: 60, height: 60}
species:
  small: {shape: {hexagon: 1}}
walls:
  gate: {box: [30, 0, 31, 60]}
stages:
  - name: packing
    fill: {region: [0, 0, 30, 60], counts: {small: 60}}
  - name: flow
    remove: [gate]
output:
  frames: {every: 10, width: 320, height: 240}
)";

/// But for the manifest.
std::set<std::string> names(const fs::path& folder) {
  std::set<std::string> result;
  for (const auto& entry : fs::directory_iterator(folder)) {
    result.insert(entry.path().filename().string());
  }
  result.erase(".clca.manifest");
  return result;
}

class RenderCommandTest : public ::testing::Test {
 protected:
  RenderCommandTest() { store("run", {}); }

  fs::path path(const fs::path& name) const { return folder_.path() / name; }
  void store(const char* run, const std::vector<scene::Override>& settings) const {
    testing::run_and_store(scene::parse(kScene, "small.yaml", settings), path(run), 2);
  }
  testing::ProgramResult render(std::vector<std::string> arguments,
                                testing::ProgramSetting setting = {}) const {
    arguments.insert(arguments.begin(), "render");
    setting.folder = folder_.path().string();
    return testing::run_program(arguments, setting);
  }
  image::Image picture(const fs::path& name) const {
    return image::decode_png(testing::bytes_of(path(name))).image;
  }
  /// One line, and nothing left behind.
  void expect_refused(const testing::ProgramResult& result, int code,
                      const ::testing::Matcher<std::string>& message) const {
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_EQ(result.out, "");
    for (const std::string& name : names(folder_.path())) {
      EXPECT_THAT(name, ::testing::Not(HasSubstr(".part"))) << "half written";
    }
  }

  testing::ScratchFolder folder_;
};

TEST_F(RenderCommandTest, DrawsTheSamePicturesAgainBesideThoseOfTheRun) {
  const auto result = render({"run"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, AllOf(HasSubstr(" pictures drawn\n"), EndsWith("run/render\n")));
  ASSERT_EQ(names(path("run/render")), names(path("run/frames")));
  for (const std::string& name : names(path("run/frames"))) {
    EXPECT_EQ(testing::bytes_of(path("run/render") / name),
              testing::bytes_of(path("run/frames") / name))
        << name;
  }
}

TEST_F(RenderCommandTest, DrawsAsTheOptionsSay) {
  const auto result = render({"run",
                              "-o",
                              "far/away",
                              "--color-by",
                              "displacement",
                              "--width",
                              "200",
                              "--height",
                              "100",
                              "--every",
                              "2",
                              "--from",
                              "4",
                              "--to",
                              "9",
                              "--set",
                              "output.frames.view=[0,0,20,10]",
                              "--set",
                              "title=Near",
                              "--quiet"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(names(path("far/away")),
            (std::set<std::string>{"small-000004.png", "small-000006.png", "small-000008.png"}));
  const image::DecodedPng png =
      image::decode_png(testing::bytes_of(path("far/away/small-000004.png")));
  EXPECT_EQ(png.image.width, 200);
  EXPECT_EQ(png.image.height, 100);
  EXPECT_EQ(png.text.at("Title"), "Near");
  EXPECT_FALSE(fs::exists(path("run/render")));
}

TEST_F(RenderCommandTest, DrawsForPapers) {
  const auto result =
      render({"run", "--style", "print", "--format", "pdf", "--from", "10", "--to", "10"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(names(path("run/render")), std::set<std::string>{"small-000010.pdf"});
  expect_refused(render({"run", "--format", "svg"}), 2, HasSubstr("--format: svg not in"));
}

TEST_F(RenderCommandTest, DrawsSeveralRunsSideBySide) {
  store("second", {"stages.packing.fill.counts.small=50"});
  const auto result = render({"run", "second", "--sheet", "both.png"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr(" moments drawn\n"), EndsWith("both.png\n")));
  EXPECT_FALSE(fs::exists(path("run/render")));
  EXPECT_EQ(render({"run", "second", "--to", "10"}).code, 0);
  EXPECT_EQ(names(path("run/render")), names(path("second/render")));
  expect_refused(render({"run", "second", "-o", "far"}), 2,
                 HasSubstr("--output goes with one run"));
  expect_refused(render({"run", "none"}), 2, HasSubstr("none"));
  expect_refused(render({"run", "./run/"}), 2, HasSubstr("./run/: is given twice"));
  const double one = run::estimated_run_bytes(scene::parse(kScene, "small.yaml"));
  const std::string enough_for_one = std::to_string(static_cast<std::uint64_t>(1.5 * one));
  expect_refused(render({"run", "second", "--memory-limit", enough_for_one}), 2,
                 HasSubstr("2 runs need about "));
}

TEST_F(RenderCommandTest, ARunWithoutPicturesOfItsOwnIsDrawnWithTheDefaults) {
  store("bare", {"output.frames=none"});
  EXPECT_EQ(render({"bare", "--from", "10", "--to", "10"}).code, 0);
  const image::Image image = picture("bare/render/small-000010.png");
  EXPECT_NEAR(image.width * image.height, 1280 * 720, 0.02 * 1280 * 720);
}

TEST_F(RenderCommandTest, ARunWithoutPicturesOfItsOwnIsDrawnWithTheViewOfTheScene) {
  store("bare", {"output.frames.view=[0, 0, 6, 12]", "output.frames=none"});
  const auto height = [&](const char* setting) {
    EXPECT_EQ(render({"bare", "--from", "10", "--to", "10", "--width", "100", "--set",
                      "output.frames.caption=false", "--set", setting})
                  .code,
              0);
    return picture("bare/render/small-000010.png").height;
  };
  EXPECT_EQ(height("output.frames.supersampling=2"), 200);
  EXPECT_EQ(height("output.frames.view=[0, 0, 6, 6]"), 100);
  EXPECT_EQ(height("output.view=[0, 0, 6, 3]"), 50);
}

TEST_F(RenderCommandTest, AMovieAndASheetNeedNoFolderOfPictures) {
  if (!process::find_program("ffmpeg")) {
    CLCA_SKIP_AS_MISSING("there is no ffmpeg");
  }
  const auto result = render({"run", "--movie", "a.mp4", "--sheet", "a.png", "--columns", "2"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, EndsWith("pictures drawn\na.mp4\na.png\n"));
  EXPECT_FALSE(fs::exists(path("run/render")));
  EXPECT_GT(fs::file_size(path("a.mp4")), 1000U);
  EXPECT_GT(picture("a.png").width, 2 * 640);
  EXPECT_EQ(names(folder_.path()), (std::set<std::string>{"a.mp4", "a.png", "run"}));
}

TEST_F(RenderCommandTest, WithoutFfmpegThereIsNoMovieAndWithTroubleItsReason) {
  const std::string missing = path("missing").string();
  expect_refused(render({"run", "--movie", "a.mp4"}, {.environment = {{"PATH", missing}}}), 1,
                 HasSubstr("ffmpeg not found; install ffmpeg (Debian)"));
  fs::create_directories(path("bin"));
  const auto expect = [&](const std::string& program, const std::string& message) {
    const fs::path file = path("bin/ffmpeg");
    std::ofstream(file) << "#!/bin/sh\n" << program;
    fs::permissions(file, fs::perms::owner_all);
    expect_refused(
        render({"run", "--movie", "a.webm"}, {.environment = {{"PATH", path("bin").string()}}}), 1,
        HasSubstr(message));
    EXPECT_FALSE(fs::exists(path("a.webm")));
  };
  expect("echo first >&2\necho 'no such encoder' >&2\nexit 1\n", "exit code 1: no such encoder");
  expect("kill -9 $$\n", "exit code 137");
}

TEST_F(RenderCommandTest, AFullDiskLeavesNoMovie) {
  CLCA_SKIP_IF_THREAD_SANITIZED();
  if (!process::find_program("ffmpeg")) {
    CLCA_SKIP_AS_MISSING("there is no ffmpeg");
  }
  expect_refused(
      render({"run", "--movie", "a.png", "--every", "2"}, {.file_size_limit = 3000}), 1,
      AllOf(StartsWith("clca: error: cannot write a.png: ffmpeg fails"), HasSubstr("too large")));
  EXPECT_FALSE(fs::exists(path("a.png")));
}

TEST_F(RenderCommandTest, CtrlCLeavesWhatIsDrawnWhole) {
  // Many pictures, and large: most are still to be drawn when the first is there.
  const auto result = render({"run", "-o", "some", "--every", "1", "--width", "3000", "--height",
                              "3000", "--set", "output.frames.supersampling=1"},
                             {.once = "some/small-000000.png", .once_has = "IEND"});
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_THAT(result.out, HasSubstr(" pictures drawn"));
  const std::set<std::string> drawn = names(path("some"));
  EXPECT_FALSE(drawn.empty());
  for (const std::string& name : drawn) {
    EXPECT_EQ(picture(path("some") / name).width, 3000) << name;
  }
}

TEST_F(RenderCommandTest, WhatCannotBeDrawnIsOneLineAndExitCodeTwo) {
  expect_refused(render({"none"}), 2, HasSubstr("none/run.json: No such file"));
  fs::create_directories(path("gas"));
  store::RunSummary gas;
  gas.kind = "boltzmann";
  gas.scene = "gas";
  store::write_whole_file(path("gas/run.json"), store::to_json(gas));
  expect_refused(render({"gas"}), 2, HasSubstr("a run of the Boltzmann equation"));
  fs::copy(path("run"), path("bare"), fs::copy_options::recursive);
  fs::remove_all(path("bare/trajectory"));
  expect_refused(render({"bare"}), 2, HasSubstr("output.trajectory"));
  fs::copy(path("run"), path("cut"), fs::copy_options::recursive);
  store::RunSummary longer = store::read_summary(path("cut/run.json"));
  ++longer.steps;
  store::write_whole_file(path("cut/run.json"), store::to_json(longer));
  expect_refused(render({"cut"}), 2, HasSubstr("part-000001.h5: missing, though the run had"));
  expect_refused(render({"run", "--from", "100000"}), 2, HasSubstr("no picture in that range"));
  expect_refused(render({"run", "--movie", "a.avi"}), 2,
                 AllOf(HasSubstr("a.avi"), HasSubstr(".mp4, .webm, .webp, .gif or .png")));
  expect_refused(render({"run", "--duration", "5"}), 2, HasSubstr("--duration requires --movie"));
  expect_refused(render({"run", "--movie", "a.mp4", "--duration", "0"}), 2,
                 HasSubstr("--duration: expected a number from 0.1 to 86400, found '0'"));
  expect_refused(render({"run", "--sheet", "a.jpg"}), 2, HasSubstr("ends in .png"));
  expect_refused(render({"run", "--sheet", "a.png", "--movie", "./a.png"}), 2,
                 HasSubstr("both movie and contact sheet"));
  expect_refused(render({"run", "--fps", "0"}), 2, HasSubstr("--fps"));
  expect_refused(render({"run", "--fps", "10"}), 2, HasSubstr("--fps requires --movie"));
  expect_refused(render({"run", "--columns", "2"}), 2, HasSubstr("--columns requires --sheet"));
}

TEST_F(RenderCommandTest, APictureOverTimeNeedsNoOtherPictures) {
  for (const std::vector<std::string>& what : {std::vector<std::string>{"--surface"},
                                               {"--column", "12.5"},
                                               {"--column", "12.5", "--slit", "4"}}) {
    std::vector<std::string> arguments = {"run", "--space-time", "a.png", "--every", "2"};
    arguments.insert(arguments.end(), what.begin(), what.end());
    const auto result = render(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, EndsWith("pictures drawn\na.png\n"));
    const image::DecodedPng png = image::decode_png(testing::bytes_of(path("a.png")));
    EXPECT_EQ(png.image.width, 320);
    EXPECT_EQ(png.image.height, 240);
    EXPECT_EQ(png.text.at("Title"), "Small");
  }
  EXPECT_FALSE(fs::exists(path("run/render")));
}

TEST_F(RenderCommandTest, OptionsOfAPictureOverTimeGoTogether) {
  const std::string either = "give --column X or --surface";
  expect_refused(render({"run", "--space-time", "a.png"}), 2, HasSubstr(either));
  expect_refused(render({"run", "--space-time", "a.png", "--surface", "--column", "3"}), 2,
                 HasSubstr(either));
  expect_refused(render({"run", "--column", "3"}), 2, HasSubstr("--column requires --space-time"));
  expect_refused(render({"run", "--surface"}), 2, HasSubstr("--surface requires --space-time"));
  expect_refused(render({"run", "--slit", "3"}), 2, HasSubstr("--slit requires --column"));
  expect_refused(render({"run", "--space-time", "a.png", "--surface", "--slit", "3"}), 2,
                 HasSubstr("--slit requires --column"));
  expect_refused(render({"run", "--space-time", "a.png", "--column", "nan"}), 2,
                 HasSubstr("--column"));
  expect_refused(render({"run", "--space-time", "a.png", "--column", "61"}), 2,
                 HasSubstr("beyond the box"));
  expect_refused(render({"run", "--space-time", "a.jpg", "--surface"}), 2,
                 HasSubstr("ends in .png"));
  expect_refused(render({"run", "--space-time", "a.png", "--surface", "--sheet", "./a.png"}), 2,
                 HasSubstr("both contact sheet and picture over time"));
  expect_refused(render({"run", "--space-time", "no/a.png", "--surface"}), 1,
                 HasSubstr("cannot write no/a.png"));
}

TEST_F(RenderCommandTest, SettingsAreThoseOfTheSceneFormat) {
  expect_refused(render({"run", "--color-by", "mood"}), 2,
                 HasSubstr("--color-by mood: error: output.frames.color_by: "));
  expect_refused(render({"run", "--width", "3"}), 2, HasSubstr("output.frames.width"));
  expect_refused(render({"run", "--overlay", "forces"}), 2, HasSubstr("passive: overlap"));
  expect_refused(render({"run", "--set", "rules.inertia=0"}), 2, HasSubstr("run the scene anew"));
  expect_refused(render({"run", "--set", "output.series={every: 3}"}), 2,
                 HasSubstr("run the scene anew"));
  expect_refused(render({"run", "--set", "output.frames=none"}), 2,
                 HasSubstr("run the scene anew"));
  expect_refused(render({"run", "--memory-limit", "1000"}), 2, HasSubstr("--memory-limit"));
}

TEST_F(RenderCommandTest, ArrowsAreNotInATrajectory) {
  const scene::Scene shaken = scene::parse(R"(clca: 1
box: {width: 30, height: 60}
species:
  grain: {shape: {hexagon: 1}}
walls:
  floor: {box: [0, 0, 30, 1], motion: {shake: {amplitude: 2}}}
stages:
  - {name: shaking, move: [floor], until: {cycles: 2}, fill: {region: [0, 2, 30, 40], counts: {grain: 20}}}
output:
  frames: {width: 200, height: 200, overlay: arrows}
)",
                                           "shaken.yaml");
  testing::run_and_store(shaken, path("shaken"), 10);
  expect_refused(render({"shaken"}), 2,
                 AllOf(HasSubstr("scene.yaml:"), HasSubstr("a trajectory does not hold")));
  EXPECT_EQ(render({"shaken", "--overlay", "none"}).code, 0);
}

TEST_F(RenderCommandTest, PlacesThatCannotBeWrittenAreFoundBeforeAnythingIsDrawn) {
  expect_refused(render({"run", "-o", "run/run.json/x"}), 1,
                 HasSubstr("cannot write to run/run.json/x"));
  fs::create_directories(path("taken.mp4"));
  expect_refused(render({"run", "--movie", "taken.mp4"}), 1, HasSubstr("cannot write taken.mp4"));
  expect_refused(render({"run", "--movie", "no/a.mp4"}), 1, HasSubstr("cannot write no/a.mp4"));
  expect_refused(render({"run", "--sheet", "no/a.png"}), 1, HasSubstr("cannot write no/a.png"));
}

TEST_F(RenderCommandTest, ANameThatLeavesTheFolderIsRefused) {
  store::RunSummary summary = store::read_summary(path("run/run.json"));
  summary.scene = "../../away";
  store::write_whole_file(path("run/run.json"), store::to_json(summary));
  expect_refused(render({"run"}), 2, HasSubstr("cannot name a file"));
}

}  // namespace
}  // namespace clca::render_test
