#include "clca/drawing/redraw.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "clca/image/png.hpp"
#include "clca/process/program.hpp"
#include "clca/render/difference.hpp"
#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/store/file.hpp"
#include "drawing/run_drawing.hpp"
#include "drawn_scenes.hpp"
#include "render/graphics.hpp"
#include "support/missing.hpp"
#include "support/runs.hpp"
#include "support/stored_run.hpp"

namespace clca::drawing::redraw_test {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// But for the manifest.
std::set<std::string> names(const fs::path& folder) {
  std::set<std::string> result;
  for (const auto& entry : fs::directory_iterator(folder)) {
    result.insert(entry.path().filename().string());
  }
  result.erase(".clca.manifest");
  return result;
}

const std::string kPushed = R"(clca: 1
box: {width: 50, height: 60}
species:
  small: {shape: {hexagon: 1}}
walls:
  plate:
    box: [10, 44, 40, 46]
    motion: {direction: down, period: 2, distance: 14}
    passive: overlap
stages:
  - name: packing
    fill: {region: [0, 0, 50, 40], counts: {small: 130}}
  - {name: push, move: [plate], max_steps: 60}
output: {frames: {every: 10, width: 200, height: 160, supersampling: 1}}
)";

class RedrawTest : public ::testing::Test {
 protected:
  scene::Scene parse(const std::string& text, const std::vector<scene::Override>& settings = {}) {
    return scene::parse(text, "tried.yaml", settings);
  }
  /// Draws again what a run with these settings has drawn, and compares all bytes.
  void expect_same_pictures(const std::string& text, const std::vector<scene::Override>& settings) {
    SCOPED_TRACE(::testing::PrintToString(settings));
    const testing::ScratchFolder scratch;
    const fs::path run = scratch.path() / "run";
    const fs::path again = scratch.path() / "again";
    const scene::Scene scene = parse(text, settings);
    if (scene.output.trajectory) {
      run::run(scene, {.folder = run});
    } else {
      testing::run_and_store(scene, run, 5);
    }
    Redraw redraw({{scene, run, store::OutputFolder(again)}}, {});
    EXPECT_EQ(redraw.draw(), redraw.moment_count());
    ASSERT_EQ(names(again), names(run / "frames"));
    ASSERT_GT(names(again).size(), 5U);
    expect_pictures_of(run, again);
  }
  /// The pictures in a folder have the bytes of those that the run has drawn.
  static void expect_pictures_of(const fs::path& run, const fs::path& again) {
    for (const std::string& name : names(again)) {
      EXPECT_EQ(testing::bytes_of(again / name), testing::bytes_of(run / "frames" / name)) << name;
    }
  }
  fs::path at(const char* name) const { return folder_.path() / name; }

  testing::ScratchFolder folder_;
};

TEST_F(RedrawTest, GivesTheBytesOfTheRunsOwnPicturesForEveryColouring) {
  for (const char* color :
       {"species", "stage_layer", "displacement", "speed", "coordination", "id"}) {
    expect_same_pictures(kDrained, {std::string("output.frames.color_by=") + color});
  }
}

TEST_F(RedrawTest, GivesTheBytesOfTheRunsOwnPicturesOfForces) {
  expect_same_pictures(kPushed, {"output.frames.color_by=force"});
  expect_same_pictures(kPushed, {"output.frames.overlay=forces"});
  expect_same_pictures(kPushed, {"output.frames.overlay=forces", "output.frames.drawing=lookup"});
}

TEST_F(RedrawTest, GivesTheBytesOfTheRunsOwnPicturesOfVelocities) {
  expect_same_pictures(kDrained, {"output.frames.overlay=velocity"});
  expect_same_pictures(kPushed, {"output.frames.overlay=velocity", "box.periodic=true",
                                 "output.frames.velocity_scale=0.01"});
}

TEST_F(RedrawTest, VelocitiesAreThoseSinceThePictureBeforeEvenIfItIsNotDrawn) {
  const scene::Scene scene = parse(kDrained, {"output.frames.overlay=velocity"});
  const fs::path run = at("run");
  const fs::path some = at("some");
  const std::uint64_t steps = testing::run_and_store(scene, run, 5).steps;
  Redraw({{scene, run, store::OutputFolder(some)}}, {.first_step = steps - 15}).draw();
  ASSERT_EQ(names(some).size(), 2U);
  expect_pictures_of(run, some);
}

TEST_F(RedrawTest, ArrowsOfAMovieHaveOneScale) {
  const scene::Scene scene = parse(kDrained, {"output.frames.overlay=velocity"});
  const fs::path run = at("run");
  testing::run_and_store(scene, run, 5);
  RunDrawing drawing({scene, run}, {}, 1e9);
  drawing.prepare_painter();
  const auto keys = [&] {
    std::set<std::string> result;
    for (std::size_t number = 0; number < drawing.picture_count(); ++number) {
      const Picture picture = drawing.painter().rasterize(drawing.capture(number));
      result.insert(picture.legend.lines.front().label);
    }
    return result;
  };
  EXPECT_GT(keys().size(), 1U) << "each picture has its own";
  drawing.unify_arrow_scale();
  EXPECT_EQ(keys().size(), 1U);
}

/// With a wall that is removed and an outlet, so that grains of contacts leave.
const std::string kContacts = R"(clca: 1
model: contact
box: {width: 40, height: 50}
species: {grain: {shape: {hexagon: 1}}}
walls: {gate: {box: [20, 0, 21, 50]}}
outlets: {drain: {region: [22, 0, 41, 8]}}
stages:
  - name: packing
    fill: {region: [0, 0, 20, 50], counts: {grain: 40}}
    until: {steps: 250}
  - {name: flow, remove: [gate], until: {steps: 330}}
output:
  frames: {every: 50, width: 200, height: 160, supersampling: 1}
  contacts: {window: 30, every: 2}
  trajectory: {every: 10, contacts: true}
)";

TEST_F(RedrawTest, GivesTheBytesOfTheRunsOwnPicturesOfTheContactModel) {
  for (const char* key : {"color_by=force", "color_by=pressure", "color_by=speed", "color_by=spin",
                          "overlay=forces", "overlay=velocity"}) {
    expect_same_pictures(kContacts, {std::string("output.frames.") + key});
  }
}

TEST_F(RedrawTest, RunsShareScalesOfTheSameUnitOnly) {
  const scene::Scene plain = parse(kContacts, {"output.frames.overlay=forces"});
  const scene::Scene metric =
      parse(kContacts, {"output.frames.overlay=forces", "units={spacing: 1 mm, density: 2.5}"});
  run::run(plain, {.folder = at("plain")});
  run::run(metric, {.folder = at("metric")});
  const auto ends = RunDrawing({plain, at("plain")}, {}, 1e9).scale_ends();
  for (const auto& [name, end] : RunDrawing({metric, at("metric")}, {}, 1e9).scale_ends()) {
    EXPECT_EQ(ends.contains(name), name == "cell") << name;
  }
  EXPECT_GT(Redraw({{plain, at("plain")}, {metric, at("metric")}}, {.sheet_file = at("sheet.png")})
                .draw(),
            0U);
}

TEST_F(RedrawTest, ATrajectoryWithoutContactsShowsNoForcesOfTheContactModel) {
  const scene::Scene scene =
      parse(kContacts, {"output.trajectory.contacts=false", "output.frames.overlay=forces"});
  run::run(scene, {.folder = at("run")});
  try {
    const Redraw none({{scene, at("run")}}, {});
    FAIL() << "no error";
  } catch (const RedrawError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr(": overlay: the trajectory of this run holds no forces; draw with the "
                          "overlay none, or run the scene again with output.trajectory.contacts: "
                          "true"));
  }
}

TEST_F(RedrawTest, DrawsStepsOfARangeOnlyOrTheNearestOneAndSaysSo) {
  const scene::Scene scene = parse(kDrained);
  testing::run_and_store(scene, at("run"), 10);
  const std::vector<RunToDraw> runs = {{scene, at("run"), store::OutputFolder(at("some"))}};
  RedrawOptions options = {.first_step = 10, .last_step = 20};
  Redraw(runs, options).draw();
  EXPECT_THAT(names(at("some")), ElementsAre("tried-000010.png", "tried-000020.png"));
  options.first_step = 16;
  options.last_step = 19;
  std::string warning;
  Redraw(runs, options).draw({.warning = [&](const std::string& text) { warning = text; }});
  EXPECT_THAT(warning,
              HasSubstr("no picture of the steps 16 to 19; step 20 of the trajectory is drawn"));
  EXPECT_THROW(picture_of_step(runs.front(), 16, 1e9), RedrawError);
  EXPECT_GT(picture_of_step(runs.front(), 20, 1e9).width, 0);
  options.first_step = 20;
  EXPECT_THROW(Redraw(runs, options), RedrawError) << "a range that ends before it begins";
}

TEST_F(RedrawTest, DrawsAStageAloneFromItsFirstFrame) {
  const scene::Scene scene = parse(kFalling, {"output.frames.every=1000"});
  testing::run_and_store(scene, at("run"), 7);
  const std::vector<RunToDraw> runs = {{scene, at("run"), store::OutputFolder(at("some"))}};
  RedrawOptions options = {.only_stage = "again"};
  Redraw(runs, options).draw();
  EXPECT_THAT(names(at("some")), ElementsAre("tried-000060.png", "tried-000100.png"));
  options.last_step = 50;
  EXPECT_THROW(Redraw(runs, options), RedrawError) << "a range before the stage";
  EXPECT_THROW(Redraw(runs, {.only_stage = "agian"}), RedrawError);
}

TEST_F(RedrawTest, AMovieOfAGivenLengthHasPicturesEvenlyChosen) {
  const scene::Scene scene = parse(kDrained, {"output.frames.every=1"});
  testing::run_and_store(scene, at("run"), 1);
  const std::vector<RunToDraw> runs = {{scene, at("run")}};
  RedrawOptions options = {.movie_file = at("a.png"), .frames_per_second = 10};
  const std::size_t all = Redraw(runs, options).moment_count();
  ASSERT_GT(all, 24U);
  options.movie_seconds = 1.2;
  EXPECT_EQ(Redraw(runs, options).moment_count(), 12U);
  options.movie_seconds = 1e3;
  EXPECT_EQ(Redraw(runs, options).moment_count(), all);
}

TEST_F(RedrawTest, AContactSheetLeavesOutPicturesThatLookLikeTheOneBefore) {
  const fs::path run = at("run");
  const scene::Scene scene = parse(kFalling, {"output.frames.every=7"});
  run::run(scene, {.folder = run});
  const auto height_of_sheet = [&](std::uint64_t from, std::uint64_t to) {
    const fs::path sheet = at("sheet.png");
    Redraw({{scene, run}},
           {.sheet_file = sheet, .sheet_columns = 1, .first_step = from, .last_step = to})
        .draw();
    return image::decode_png(testing::bytes_of(sheet)).image.height;
  };
  // They lie on the table from step 49 on.
  EXPECT_EQ(height_of_sheet(49, 60), height_of_sheet(49, 49));
  EXPECT_GT(height_of_sheet(14, 28), height_of_sheet(14, 21));
}

TEST_F(RedrawTest, AContactSheetShowsPicturesEvenlyChosenWithoutWritingThem) {
  const scene::Scene scene = parse(kDrained, {"output.frames.every=1"});
  testing::run_and_store(scene, at("run"), 2);
  const fs::path sheet = at("sheet.png");
  Redraw redraw({{scene, at("run")}}, {.sheet_file = sheet, .sheet_columns = 4});
  EXPECT_GT(redraw.draw(), 24U);
  const image::DecodedPng png = image::decode_png(testing::bytes_of(sheet));
  EXPECT_EQ(png.text.at("Title"), "Drained");
  EXPECT_GT(png.image.width, 4 * 480);
  EXPECT_GT(png.image.height, 6 * 384);
  EXPECT_LT(png.image.height,
            6 * (672 + 100) + 200);  // a view is at most 1.4 times as high as wide
  EXPECT_FALSE(fs::exists(at("run/render")));
}

TEST_F(RedrawTest, TilesOfASheetLookAsThePicturesMadeSmaller) {
  const scene::Scene scene =
      parse(kDrained, {"output.frames={every: 20, width: 1280, view: [0, 0, 40, 20]}"});
  const fs::path run_folder = at("run");
  testing::run_and_store(scene, run_folder, 2);
  const auto sheet = [&](const char* name, const std::optional<store::OutputFolder>& pictures) {
    const fs::path file = folder_.path() / name;
    Redraw({{scene, run_folder, pictures}}, {.sheet_file = file, .sheet_columns = 3}).draw();
    return image::decode_png(testing::bytes_of(file)).image;
  };
  const image::Image small = sheet("small.png", std::nullopt);
  const image::Image made_smaller = sheet("smaller.png", store::OutputFolder(at("pictures")));
  ASSERT_EQ(small.width, made_smaller.width);
  ASSERT_EQ(small.height, made_smaller.height);
  EXPECT_LT(render::difference_of(small, made_smaller, 64).differing_pixels,
            small.pixels.size() / 1000);
}

TEST_F(RedrawTest, AskedToStopItLeavesWhatIsDrawnWhole) {
  const scene::Scene scene = parse(kDrained, {"output.frames.every=1"});
  testing::run_and_store(scene, at("run"), 1);
  std::atomic<int> stop = 0;
  Redraw redraw({{scene, at("run"), store::OutputFolder(at("some"))}},
                {.sheet_file = at("sheet.png"), .stop_signal = &stop});
  const std::size_t drawn =
      redraw.draw({.progress = [&](const RedrawProgress&) { stop = 2; }, .progress_interval = {}});
  EXPECT_GT(drawn, 0U);
  EXPECT_LT(drawn, redraw.moment_count());
  EXPECT_EQ(names(at("some")).size(), drawn);
  image::decode_png(testing::bytes_of(at("sheet.png")));

  stop = 2;
  EXPECT_EQ(
      Redraw({{scene, at("run")}}, {.sheet_file = at("none.png"), .stop_signal = &stop}).draw(),
      0U);
  EXPECT_FALSE(fs::exists(at("none.png")));
}

TEST_F(RedrawTest, SeveralRunsShareTheEndsOfTheirColourBars) {
  const std::vector<scene::Override> look = {"output.frames.color_by=displacement",
                                             "output.frames.caption=false"};
  const scene::Scene high = parse(kDrained, look);
  std::vector<scene::Override> settings = look;
  settings.emplace_back("stages.packing.fill={region: [0, 0, 30, 20], counts: {small: 20}}");
  const scene::Scene lower = parse(kDrained, settings);
  testing::run_and_store(high, at("high"), 10);
  testing::run_and_store(lower, at("lower"), 10);
  const auto last_picture = [&](const std::vector<RunToDraw>& runs) {
    Redraw(runs, {.last_step = 20}).draw();
    const fs::path folder = runs.back().picture_folder->path();
    return image::decode_png(testing::bytes_of(folder / *names(folder).rbegin())).image;
  };
  const auto together =
      last_picture({{high, at("high")}, {lower, at("lower"), store::OutputFolder(at("together"))}});
  const auto alone = last_picture({{lower, at("lower"), store::OutputFolder(at("alone"))}});
  EXPECT_NE(together, alone);
  // A range in the scene is that of both.
  settings.emplace_back("output.frames.range=[0,7]");
  const scene::Scene ranged = parse(kDrained, settings);
  EXPECT_EQ(
      last_picture({{high, at("high")}, {ranged, at("lower"), store::OutputFolder(at("ranged"))}}),
      last_picture({{ranged, at("lower"), store::OutputFolder(at("ranged-alone"))}}));
}

TEST_F(RedrawTest, SeveralRunsStandSideBySideAtEqualSteps) {
  const scene::Scene often = parse(kDrained, {"output.frames.every=10"});
  const scene::Scene rarely =
      parse(kDrained, {"output.frames.every=25", "output.frames.width=120", "title=Rare"});
  testing::run_and_store(often, at("often"), 5);
  testing::run_and_store(rarely, at("rarely"), 5);
  const fs::path sheet = at("sheet.png");
  const fs::path movie = at("movie.png");
  Redraw redraw({{often, at("often")}, {rarely, at("rarely")}},
                {.movie_file = movie, .sheet_file = sheet, .sheet_columns = 9});
  EXPECT_EQ(redraw.draw(), redraw.moment_count());
  const Redraw alone({{often, at("often")}}, {});
  EXPECT_GE(redraw.moment_count(),
            alone.moment_count());  // all of its moments and some of the other
  const image::Image picture = image::decode_png(testing::bytes_of(movie)).image;
  EXPECT_EQ(picture.width, 200 + 120);
  EXPECT_EQ(picture.height, 160);
  const image::DecodedPng png = image::decode_png(testing::bytes_of(sheet));
  EXPECT_GT(png.image.width, 2 * 640);  // a column for each
  EXPECT_LT(png.image.width, 3 * 640);
}

/// As another program shows it, with a pixel for each of the picture.
image::Image shown(const fs::path& pdf) {
  const fs::path picture = fs::path(pdf).replace_extension("");
  const process::OutputCapture none;
  EXPECT_EQ(process::Program({process::find_program("pdftoppm").value(), "-r", "96", "-png",
                              "-singlefile", pdf.string(), picture.string()},
                             {.error_output = &none})
                .wait(),
            0);
  return image::decode_png(testing::bytes_of(picture.string() + ".png")).image;
}

TEST_F(RedrawTest, APdfShowsWhatThePictureShows) {
  if (!process::find_program("pdftoppm")) {
    CLCA_SKIP_AS_MISSING("there is no pdftoppm");
  }
  for (const char* drawing : {"polygons", "lookup"}) {
    SCOPED_TRACE(drawing);
    const scene::Scene scene = parse(
        kDrained, {std::string("output.frames.drawing=") + drawing, "output.frames.caption=false",
                   "output.frames.width=800", "output.frames.height=640"});
    const fs::path run = folder_.path() / (std::string("run-") + drawing);
    testing::run_and_store(scene, run, 5);
    const fs::path pdf = folder_.path() / (std::string("pdf-") + drawing);
    Redraw({{scene, run, store::OutputFolder(pdf)}}, {.as_pdf = true, .last_step = 30}).draw();
    for (const char* name : {"tried-000000", "tried-000030"}) {
      const image::Image page = shown(pdf / (std::string(name) + ".pdf"));
      const image::Image picture =
          image::decode_png(testing::bytes_of(run / "frames" / (std::string(name) + ".png"))).image;
      ASSERT_EQ(page.width, picture.width);
      ASSERT_EQ(page.height, picture.height);
      // Each program draws edges in its own way, and shifts pictures by up to a pixel.
      const auto means = [](const image::Image& image) {
        return render::resized(image, image.width / 16, image.height / 16);
      };
      EXPECT_LE(render::difference_of(means(page), means(picture), 0).largest_difference, 32)
          << name;
    }
    const std::vector<std::uint8_t> once = testing::bytes_of(pdf / "tried-000030.pdf");
    Redraw({{scene, run, store::OutputFolder(pdf)}},
           {.as_pdf = true, .first_step = 30, .last_step = 30})
        .draw();
    EXPECT_EQ(testing::bytes_of(pdf / "tried-000030.pdf"), once);
  }
}

using Frames = std::vector<store::Trajectory::Frame>;

TEST(FrameChoiceTest, StagesBeginAndEndWithAPictureAndNoStepIsDrawnTwice) {
  const Frames frames = {{0, 0, 1},  {4, 0, 1},  {8, 0, 1},  {10, 0, 1}, {10, 1, 1},
                         {14, 1, 1}, {18, 1, 1}, {22, 1, 1}, {26, 1, 1}, {27, 1, 1}};
  EXPECT_THAT(chosen_frames(frames, 1), ElementsAre(0, 1, 2, 3, 5, 6, 7, 8, 9));
  EXPECT_THAT(chosen_frames(frames, 8), ElementsAre(0, 2, 3, 6, 8, 9));
  EXPECT_THAT(chosen_frames(frames, 10), ElementsAre(0, 3, 7, 9));
  EXPECT_THAT(chosen_frames(frames, 1000), ElementsAre(0, 3, 9));
  EXPECT_THAT(chosen_frames({{3, 0, 0}}, 5), ElementsAre(0));
  EXPECT_TRUE(chosen_frames({}, 5).empty());
}

TEST(FrameChoiceTest, SomeOfManyLieEvenlyWithBothEnds) {
  for (const std::size_t most : {2U, 6U, 24U, 97U}) {
    for (const std::size_t count : {1U, 2U, 5U, 24U, 25U, 47U, 48U, 49U, 1000U}) {
      std::vector<std::size_t> chosen;
      for (std::size_t i = 0; i < count; ++i) {
        if (is_evenly_chosen(i, count, most)) {
          chosen.push_back(i);
        }
      }
      ASSERT_EQ(chosen.size(), std::min(most, count)) << most << " of " << count;
      EXPECT_EQ(chosen.front(), 0U);
      EXPECT_TRUE(count == 1 || chosen.back() == count - 1);
      const std::size_t gap = (count - 1) / std::max<std::size_t>(1, chosen.size() - 1);
      for (std::size_t k = 1; k < chosen.size(); ++k) {
        EXPECT_LE(chosen[k] - chosen[k - 1], gap + 1) << most << " of " << count;
        EXPECT_GE(chosen[k] - chosen[k - 1] + 1, gap) << most << " of " << count;
      }
    }
  }
}

}  // namespace
}  // namespace clca::drawing::redraw_test
