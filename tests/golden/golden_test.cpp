// Pictures against those in renders/golden/. With CLCA_BLESS=1 in the environment they are written
// anew instead (scripts/bless). Captions are left out, since they depend on the installed font.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <ostream>
#include <stdexcept>

#include "clca/automaton/automaton.hpp"
#include "clca/drawing/redraw.hpp"
#include "clca/image/png.hpp"
#include "clca/model/initial_state.hpp"
#include "clca/render/coloring.hpp"
#include "clca/render/difference.hpp"
#include "clca/render/painter.hpp"
#include "clca/store/file.hpp"
#include "support/runs.hpp"

namespace clca::golden_test {
namespace {

namespace fs = std::filesystem;

// Pictures are compared exactly, but for polygons: their rounding at edges may differ between
// processors (4 pixels of 300,000 with emulated SSE4.1); one grain in another place changes more
// than a hundred.
constexpr int kTolerance = 24;
constexpr std::size_t kPixels = 16;

struct GoldenCase {
  std::string name;
  std::string scene;
  std::vector<scene::Override> overrides;
};

/// For the names of the tests.
// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const GoldenCase& golden, std::ostream* stream) {
  *stream << golden.name;
}

scene::Scene scene_of(const GoldenCase& golden) {
  std::vector<scene::Override> overrides = {
      "output.series={every: 1000000}", "output.frames.every=1000000", "output.frames.width=640",
      "output.frames.height=360", "output.frames.caption=false"};
  overrides.insert(overrides.end(), golden.overrides.begin(), golden.overrides.end());
  const fs::path file = fs::path(CLCA_SOURCE_DIR) / "scenes" / (golden.scene + ".yaml");
  return scene::parse_file(file, overrides);
}

/// The last picture of a run.
image::Image last_picture(const scene::Scene& scene, const fs::path& folder) {
  const auto summary = run::run(scene, {.folder = folder});
  const auto picture = folder / "frames" / fmt::format("{}-{:06}.png", scene.name, summary.steps);
  return image::decode_png(testing::bytes_of(picture)).image;
}

void compare_or_bless(const std::string& name, const image::Image& image, bool exact) {
  const fs::path expected_file = fs::path(CLCA_SOURCE_DIR) / "renders" / "golden" / (name + ".png");
  if (std::getenv("CLCA_BLESS") != nullptr) {
    store::write_whole_file(expected_file, image::encode_png(image, {{"Title", name}}));
    return;
  }
  const image::Image expected = image::decode_png(testing::bytes_of(expected_file)).image;
  ASSERT_EQ(image.width, expected.width);
  ASSERT_EQ(image.height, expected.height);
  const render::Difference difference =
      render::difference_of(expected, image, exact ? 0 : kTolerance);
  if (difference.differing_pixels <= (exact ? 0 : kPixels)) {
    return;
  }
  const fs::path folder(CLCA_FAILURES_DIR);
  fs::create_directories(folder);
  store::write_whole_file(folder / (name + ".png"), image::encode_png(image, {}));
  store::write_whole_file(folder / (name + "-difference.png"),
                          image::encode_png(difference.picture, {}));
  ADD_FAILURE() << difference.differing_pixels << " pixels differ by up to "
                << difference.largest_difference << " in x " << difference.differing_box.min().x()
                << " to " << difference.differing_box.max().x() << ", y "
                << difference.differing_box.min().y() << " to "
                << difference.differing_box.max().y() << "; see "
                << (folder / (name + "-difference.png")).string();
}

class Golden : public ::testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, PictureIsAsBlessed) {
  const testing::ScratchFolder folder;
  const scene::Scene scene = scene_of(GetParam());
  compare_or_bless(GetParam().name, last_picture(scene, folder.path()),
                   scene.output.frames->drawing != scene::DrawingMethod::polygons);
}

std::vector<GoldenCase> golden_cases() {
  const auto colored = [](const char* by) { return fmt::format("output.frames.color_by={}", by); };
  const std::string early = "stages.flow.until={steps: 60}";
  return {
      {"wall-removal-species-polygons", "wall-removal", {early, "output.frames.drawing=polygons"}},
      {"wall-removal-species-lookup", "wall-removal", {early}},
      {"wall-removal-displacement", "wall-removal", {colored("displacement")}},
      {"wall-removal-speed", "wall-removal", {early, colored("speed")}},
      {"silo-collapse-layers", "silo-collapse", {"stages.collapse.until={steps: 300}"}},
      {"silo-collapse-displacement",
       "silo-collapse",
       {colored("displacement"), "output.frames.drawing=lookup"}},
      {"heap-id", "heap", {"sources.spout.count=400"}},
      {"silo-discharge-portrait",
       "silo-discharge",
       {"stages.discharge.until={steps: 200}", "output.frames.width=360",
        "output.frames.height=640"}},
      {"shapes",
       "wall-removal",
       {early, "species.small={shape: {rod: {radius: 0, length: 4}}, orientations: any}",
        "species.large={shape: {polygon: [[0, 0], [3, 0], [0, 3]]}, orientations: any}"}},
      {"periodic-slanted-wall",
       "wall-removal",
       {"box.periodic=true", "walls.right={line: {from: [87, 0], to: [130, 100], thickness: 3}}",
        early, "output.frames.view=[-4, -4, 304, 169]"}},
      {"force-network",
       "plate-penetration",
       {"box={width: 70, height: 160}", "output.frames.width=480", "output.frames.height=400",
        "walls.plate={box: [31.5, 62, 38.5, 160], passive: overlap, "
        "motion: {direction: down, period: 4, distance: 50}}",
        "stages.packing.fill={region: [0, 0, 70, 160], counts: {small: 125, large: 125}}",
        "output.frames.view=[-3, -4, 73, 59]"}},
      {"piston-force",
       "piston",
       {"output.frames.width=480", "output.frames.height=540", "output.frames.overlay=none"}},
      {"convection-arrows",
       "convection",
       {"stages.shaking.until.cycles=60", "output.frames.width=400", "output.frames.height=450"}},
      {"velocity-arrows",
       "silo-discharge",
       {"stages.discharge.until={steps: 200}", "output.frames.overlay=velocity",
        "output.frames.every=20", "output.frames.width=360", "output.frames.height=640"}},
      {"segregation",
       "segregation",
       {"stages.tapping.until.cycles=100", "output.frames.width=240", "output.frames.height=560"}},
      {"axes",
       "outlet",
       {"model=baxter", "let.d=1.05", "species.small.shape.hexagon=0",
        "species.large.shape.hexagon=0", colored("axis"), "output.frames.width=480",
        "output.frames.height=400", "output.frames.view=[16.5, 0, 46.5, 25]"}},
      {"lifted-floor",
       "brazil-nut",
       {"stages.shaking.until={steps: 7}", "output.frames.width=360", "output.frames.height=480"}},
      {"slanted-pusher",
       "wall-removal",
       {"walls.pusher={line: {from: [28, 0], to: [2, 45], thickness: 3}, "
        "motion: {direction: up_right, distance: 15}}",
        "stages.flow.move=[pusher]", "stages.flow.until={steps: 20}"}},
  };
}

INSTANTIATE_TEST_SUITE_P(Pictures, Golden, ::testing::ValuesIn(golden_cases()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// A picture over time of a silo that runs out.
image::Image space_time(std::optional<double> column) {
  const testing::ScratchFolder folder;
  const scene::Scene scene = scene::parse_file(
      fs::path(CLCA_SOURCE_DIR) / "scenes" / "silo-discharge.yaml",
      {"stages.discharge.until={steps: 400}", "lines={}", "output.series=none",
       "output.trajectory={every: 6}",
       "output.frames={every: 6, width: 320, height: 180, caption: false, color_by: stage_layer, "
       "layers: 5, view: [-5, 0, 110, 220]}"});
  run::run(scene, {.folder = folder.path() / "run", .pictures = run::WantedPictures::last});
  drawing::Redraw redraw({{scene, folder.path() / "run"}},
                         {.space_time = drawing::SpaceTimeOptions{
                              .file = folder.path() / "over-time.png", .column_x = column}});
  redraw.draw();
  return redraw.space_time_picture().plot_image;
}

TEST(GoldenOverTime, AColumnAndTheSurfaceAreAsBlessed) {
  compare_or_bless("space-time-column", space_time(52), true);
  compare_or_bless("space-time-surface", space_time({}), true);
}

/// The state with some small particle, that has room above, one spacing higher.
grains::State with_one_lifted(const grains::State& state) {
  for (std::size_t id = 0; id < state.particles.size(); ++id) {
    grains::State changed = state;
    ++changed.particles[id].row;
    if (changed.kinds[changed.particles[id].kind].species == 0) {
      try {
        const grains::Occupancy fits(changed);
        return changed;
      } catch (const std::invalid_argument&) {
        continue;
      }
    }
  }
  throw std::logic_error("no particle has room above");
}

TEST(GoldenComparison, NoticesOneParticleInAnotherPlace) {
  const scene::Scene scene = testing::bare_scene("wall-removal", {});
  automaton::Automaton automaton(model::initial_state(scene), scene.automaton_rules);
  automaton.fill(scene.stages[0].fill->region, scene.stages[0].fill->species_counts);
  while (!automaton.step().settled) {
  }
  const grains::State changed = with_one_lifted(automaton.state());
  for (const render::DrawingMethod drawing :
       {render::DrawingMethod::polygons, render::DrawingMethod::lookup}) {
    const render::Style style = {.width = 640,
                                 .height = 360,
                                 .supersampling = 2,
                                 .drawing = drawing,
                                 .view = {-4, -4, 188, 104},
                                 .annotations = render::Annotations::none};
    render::Painter painter(style, changed.lattice, changed.kinds);
    const render::Coloring coloring = render::color_by_id(changed);
    const image::Image before =
        painter.draw(automaton.state(), automaton.occupancy(), coloring, {});
    const image::Image after = painter.draw(changed, grains::Occupancy(changed), coloring, {});
    EXPECT_GT(render::difference_of(before, after, kTolerance).differing_pixels, 2 * kPixels);
  }
}

}  // namespace
}  // namespace clca::golden_test
