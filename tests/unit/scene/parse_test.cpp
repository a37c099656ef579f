#include "clca/scene/parse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "bad_scenes.hpp"
#include "support/runs.hpp"

namespace clca::scene::parse_test {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::string_view kLeast = R"(
clca: 1
box: {width: 100, height: 50}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: only, fill: {region: [0, 0, 100, 50], counts: {grain: 3}}}]
)";

Scene scene_with(std::string_view part) {
  return parse(testing::scene_with(part), "scene.yaml");
}

std::string refusal_of_file(const std::filesystem::path& file) {
  try {
    parse_file(file);
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

}  // namespace

TEST(Parse, FillsInTheDefaultsOfTheLeastScene) {
  const Scene scene = parse(kLeast, "folder/least.yaml");
  EXPECT_EQ(scene.name, "least");
  EXPECT_EQ(scene.title, "least");
  EXPECT_EQ(scene.seed, 1);
  EXPECT_FALSE(scene.box.periodic);
  EXPECT_EQ(scene.automaton_rules, automaton::Rules());
  EXPECT_TRUE(scene.walls.empty());
  EXPECT_THAT(scene.species[0].orientations, ElementsAre(0));
  EXPECT_FALSE(scene.species[0].color.has_value());
  EXPECT_TRUE(std::holds_alternative<UntilSettled>(scene.stages[0].until));
  EXPECT_EQ(scene.stages[0].max_steps, 1'000'000);
  EXPECT_EQ(scene.measures.size(), 11U);  // all
  EXPECT_FALSE(scene.output.frames.has_value());
  EXPECT_FALSE(scene.output.series.has_value());
}

TEST(Parse, ReadsTitleSeedAndBox) {
  const Scene scene = scene_with(
      "title: 'Körner: 50 % \"small\"'\nseed: 18446744073709551615\n"
      "box: {width: 99.5, height: 50, periodic: true}");
  EXPECT_EQ(scene.title, "Körner: 50 % \"small\"");
  EXPECT_EQ(scene.seed, 18446744073709551615U);
  EXPECT_EQ(scene.box.width, 99.5);
  EXPECT_EQ(scene.box.height, 50);
  EXPECT_TRUE(scene.box.periodic);
}

TEST(Parse, TakesANumberForATitle) {
  EXPECT_EQ(scene_with("title: 2001").title, "2001");
}

TEST(Parse, TakesTheNameOfTheFileForATitle) {
  EXPECT_EQ(parse(kLeast, std::string(200, 'x') + ".yaml").title, std::string(200, 'x'));
  EXPECT_EQ(parse(kLeast, "a\nb.yaml").title, "a\\nb");
}

TEST(Parse, ReadsTheFourKindsOfShapes) {
  const Scene scene = scene_with(
      "species:\n"
      "  small: {shape: {hexagon: 1}}\n"
      "  pair: {shape: {sites: [[0, 0], [0, 1]]}}\n"
      "  triangle: {shape: {polygon: [[0, 0], [2, 0], [0, 2]]}}\n"
      "  rod: {shape: {rod: {radius: 1, length: 4}}}\n");
  const auto sizes = [&](std::size_t i) { return scene.species[i].shape.size(); };
  EXPECT_EQ(scene.species[0].shape, lattice::Shape::hexagon(1));
  EXPECT_EQ(std::get<HexagonSpec>(scene.species[0].shape_spec).radius, 1);
  EXPECT_EQ(sizes(1), 2);
  EXPECT_EQ(sizes(2), 6);
  EXPECT_EQ(scene.species[3].shape, lattice::Shape::rod(1, 4));
  EXPECT_EQ(std::get<RodSpec>(scene.species[3].shape_spec).length, 4);
}

TEST(Parse, ReadsRectanglesAndOutlinesInSpacings) {
  const Scene scene = scene_with(
      "species:\n"
      "  small: {shape: {rectangle: [3, 5]}}\n"
      "  dot: {shape: {rectangle: [0.1, 0.1]}}\n"
      "  ell: {shape: {outline: [[0, 0], [5.2, 0], [5.2, 2], [1.8, 2], [1.8, 6], [0, 6]]}}\n"
      "  upright: {shape: {outline: [[-1.8, -1], [1.8, -1], [1.8, 1], [-1.8, 1]]}}\n");
  using lattice::Axial;
  const auto sites = [&](std::size_t i) { return scene.species[i].shape.sites(); };
  // Three columns, 0.866 apart, of five sites, the middle one half a spacing higher.
  EXPECT_EQ(sites(0), lattice::Shape::polygon(
                          std::vector<Axial>{{0, 0}, {1, 0}, {2, -1}, {2, 3}, {1, 4}, {0, 4}})
                          .sites());
  EXPECT_EQ(sites(1).size(), 1);
  for (const Axial site : sites(2)) {
    const Eigen::Vector2d at = position(site);
    EXPECT_TRUE(at.x() > -1e-9 && at.x() < 5.2 && at.y() > -1e-9 && at.y() < 6 + 1e-9 &&
                (at.x() < 1.8 || at.y() < 2 + 1e-9))
        << at.transpose();
  }
  // Columns at 0, 0.87 and 1.73 have 7, 6 and 7 sites, those at 2.6, 3.46, 4.33 and 5.20 2, 3,
  // 2, 3.
  EXPECT_EQ(sites(2).size(), 7 + 6 + 7 + 2 + 3 + 2 + 3);
  EXPECT_EQ(sites(3).size(), 3 + 2 * 2 + 2 * 3) << "both edges belong to it";
}

TEST(Parse, RefusesTheSpeciesWithWhichAllHaveTooManySites) {
  std::string species = "species:\n";
  for (char name = 'a'; name <= 'u'; ++name) {  // 21 of 99,225 sites
    species += "  " + std::string(1, name) +
               ": {shape: {polygon: [[0, 0], [314, 0], [314, 314], [0, 314]]}}\n";
  }
  EXPECT_THAT([&] { scene_with(species); },
              ::testing::ThrowsMessage<SceneError>(
                  "scene.yaml:26:14: error: species.u.shape: with this shape all species have more "
                  "than 2000000 sites"));
}

TEST(Parse, ReadsOrientationsAndColours) {
  const Scene scene = scene_with(
      "species:\n"
      "  small: {shape: {hexagon: 1}, orientations: any, color: \"#3a6eA5\"}\n"
      "  large: {shape: {hexagon: 2}, orientations: [120, 0]}\n");
  EXPECT_THAT(scene.species[0].orientations, ElementsAre(0, 60, 120, 180, 240, 300));
  EXPECT_EQ(scene.species[0].color, (image::Rgb{0x3A, 0x6E, 0xA5}));
  EXPECT_THAT(scene.species[1].orientations, ElementsAre(120, 0));
}

TEST(Parse, KeepsTheOrderOfTheFile) {
  const Scene scene = scene_with(
      "species:\n"
      "  small: {shape: {hexagon: 3}}\n"
      "  zebra: {shape: {hexagon: 1}}\n"
      "  ant: {shape: {hexagon: 2}}\n");
  EXPECT_EQ(scene.species[1].name, "zebra");
  EXPECT_EQ(scene.species[2].name, "ant");
}

TEST(Parse, ReadsEveryRule) {
  const Scene scene = scene_with(
      "rules: {inertia: 1, scatter: .25, candidates: all, gravity: up_left, "
      "update_priority: [gravity, rest, inertia], ties: direction}\n"
      "stages: [{name: first, sources: [spout], max_steps: 9}]");
  using automaton::UpdateClass;
  EXPECT_EQ(scene.automaton_rules.inertia, 1);
  EXPECT_EQ(scene.automaton_rules.scatter, 0.25);
  EXPECT_EQ(scene.automaton_rules.candidates, automaton::CandidateDirections::all);
  EXPECT_EQ(scene.automaton_rules.gravity, lattice::Direction::up_left);
  EXPECT_THAT(scene.automaton_rules.update_priority,
              ElementsAre(UpdateClass::gravity, UpdateClass::rest, UpdateClass::inertia));
  EXPECT_EQ(scene.automaton_rules.ties, automaton::TieBreaking::direction);
}

TEST(Parse, ReadsWallsOfBothForms) {
  const Scene scene = scene_with(
      "walls:\n"
      "  right: {box: [50, 0, 51.5, 50]}\n"
      "  slope: {line: {from: [0, 10], to: [40, 0]}}\n"
      "  thick: {line: {from: [-10, 10], to: [40, 0], thickness: 2.5}}\n");
  EXPECT_EQ(std::get<lattice::Rectangle>(scene.walls[0].parts.at(0)),
            (lattice::Rectangle{50, 0, 51.5, 50}));
  const auto& slope = std::get<lattice::Segment>(scene.walls[1].parts.at(0));
  EXPECT_EQ(slope.to, Eigen::Vector2d(40, 0));
  EXPECT_EQ(slope.thickness, 1);
  EXPECT_EQ(std::get<lattice::Segment>(scene.walls[2].parts.at(0)).thickness, 2.5);
}

TEST(Parse, ReadsRoundWalls) {
  const Scene scene = scene_with(
      "walls:\n"
      "  rock: {disc: {centre: [-2, 10], radius: 4.5}}\n"
      "  drum: {ring: {centre: [50, 25], radius: 20}}\n"
      "  bowl: {parts: [{arc: {centre: [20, 25], radius: 9, thickness: 2, from: -200, to: "
      "20}}]}\n");
  const auto& disc = std::get<Disc>(scene.walls[0].parts.at(0));
  EXPECT_EQ(disc.centre, Eigen::Vector2d(-2, 10));
  EXPECT_EQ(disc.radius, 4.5);
  const auto& ring = std::get<Ring>(scene.walls[1].parts.at(0));
  EXPECT_EQ(ring.centre, Eigen::Vector2d(50, 25));
  EXPECT_EQ(ring.radius, 20);
  EXPECT_EQ(ring.thickness, 1);
  const auto& arc = std::get<Arc>(scene.walls[2].parts.at(0));
  EXPECT_EQ(arc.ring.centre, Eigen::Vector2d(20, 25));
  EXPECT_EQ(arc.ring.radius, 9);
  EXPECT_EQ(arc.ring.thickness, 2);
  EXPECT_EQ(arc.from_degrees, -200);
  EXPECT_EQ(arc.to_degrees, 20);
}

TEST(Parse, AcceptsAWallThatOnlyGrazesTheBox) {
  EXPECT_NO_THROW(scene_with("walls: {rock: {disc: {centre: [0, -5], radius: 5}}}"));
  EXPECT_NO_THROW(scene_with("walls: {edge: {line: {from: [0, 0], to: [0, 50]}}}"));
  EXPECT_NO_THROW(scene_with("walls: {corner: {line: {from: [-1, 1], to: [1, -1]}}}"));
  EXPECT_NO_THROW(scene_with("walls: {roof: {line: {from: [0, 51], to: [9, 51], thickness: 5}}}"));
}

TEST(Parse, ReadsSourcesAtPointsAndInRegions) {
  const Scene scene = scene_with(
      "sources:\n"
      "  spout: {at: [20, 40], rate: 0.5, count: 9}\n"
      "  rain: {region: [0, 40, 100, 50], species: {large: 3}, rate: 2}\n"
      "stages: [{name: first, sources: [rain, spout], until: {steps: 9}}]");
  EXPECT_EQ(std::get<Eigen::Vector2d>(scene.sources[0].position), Eigen::Vector2d(20, 40));
  EXPECT_THAT(scene.sources[0].species_weights, ElementsAre(1, 1));
  EXPECT_EQ(scene.sources[0].max_particles, 9);
  EXPECT_THAT(scene.sources[1].species_weights, ElementsAre(0, 3));
  EXPECT_EQ(scene.sources[1].particles_per_step, 2);
  EXPECT_FALSE(scene.sources[1].max_particles.has_value());
  EXPECT_THAT(scene.stages[0].open_sources, ElementsAre(1, 0));
}

TEST(Parse, ReadsStages) {
  const Scene scene = scene_with(
      "stages:\n"
      "  - name: first\n"
      "    fill: {region: [0, 0, 50, 50], counts: {large: 4}}\n"
      "    sources: [spout]\n"
      "    until: {steps: 2000000}\n"
      "  - name: 2nd_stage\n"
      "    remove: [right, left]\n"
      "    until: {discharged: 0.9}\n"
      "    max_steps: 50\n");
  EXPECT_EQ(scene.stages[0].fill->region, (lattice::Rectangle{0, 0, 50, 50}));
  EXPECT_THAT(scene.stages[0].fill->species_counts, ElementsAre(0, 4));
  EXPECT_EQ(std::get<UntilSteps>(scene.stages[0].until).steps, 2'000'000);
  EXPECT_EQ(scene.stages[0].max_steps, 2'000'000) << "the default bound gives way";
  EXPECT_THAT(scene.stages[1].removed_walls, ElementsAre(1, 0));
  EXPECT_EQ(std::get<UntilDischarged>(scene.stages[1].until).discharged_share, 0.9);
  EXPECT_EQ(scene.stages[1].max_steps, 50);
}

TEST(Parse, ReadsMeasuresAndOutput) {
  const Scene scene = scene_with(
      "measure: [moved, profile]\n"
      "output:\n"
      "  frames: {every: 5, width: 640, height: 480, color_by: stage_layer, layers: 4,\n"
      "           view: [-5, 0, 50, 40], drawing: lookup, supersampling: 4, caption: false}\n"
      "  series: {every: 3}\n"
      "  trajectory: {every: 7}");
  EXPECT_THAT(scene.measures, ElementsAre(Measure::moved, Measure::profile));
  PictureOutput frames = *scene.output.frames;
  frames.location.clear();
  EXPECT_EQ(frames, (PictureOutput{.every = 5,
                                   .width = 640,
                                   .height = 480,
                                   .color_by = ColorBy::stage_layer,
                                   .layer_count = 4,
                                   .view = lattice::Rectangle{-5, 0, 50, 40},
                                   .drawing = DrawingMethod::lookup,
                                   .supersampling = 4,
                                   .has_caption = false,
                                   .location = {}}));
  EXPECT_EQ(scene.output.series->every, 3);
  EXPECT_EQ(scene.output.trajectory->every, 7);
}

TEST(Parse, TakesNoneForFramesAndSeriesAndNoMeasures) {
  const Scene scene =
      scene_with("measure: []\noutput: {frames: none, series: none, checkpoint: none}");
  EXPECT_TRUE(scene.measures.empty());
  EXPECT_THAT(to_yaml(scene), ::testing::EndsWith("\noutput:\n"
                                                  "  frames: none\n"
                                                  "  series: none\n"
                                                  "  fields: none\n"
                                                  "  contacts: none\n"
                                                  "  trajectory: none\n"
                                                  "  checkpoint: none\n"));
}

TEST(Parse, TakesAnEmptyMapForDefaults) {
  EXPECT_EQ(scene_with("output: {trajectory: {}}").output.trajectory->every, 10);
}

TEST(Parse, SavesEveryMinuteUnlessTheSceneSaysOtherwise) {
  EXPECT_EQ(scene_with("").output.checkpoint->every_seconds, kDefaultCheckpoints.every_seconds);
  EXPECT_EQ(scene_with("output: {}").output.checkpoint->every_seconds,
            kDefaultCheckpoints.every_seconds);
  EXPECT_FALSE(scene_with("output: {checkpoint: none}").output.checkpoint.has_value());
  const auto by_steps = scene_with("output: {checkpoint: {every: 9}}").output.checkpoint;
  EXPECT_EQ(by_steps->every_steps, 9);
  EXPECT_EQ(by_steps->every_seconds, std::nullopt);
  const auto by_both =
      scene_with("output: {checkpoint: {every: 9, seconds: 0.5}}").output.checkpoint;
  EXPECT_EQ(by_both->every_steps, 9);
  EXPECT_EQ(by_both->every_seconds, 0.5);
  EXPECT_EQ(scene_with("output: {frames: {}}").output.frames->every, 10);
}

TEST(Parse, KeepsThePlacesThatLaterMessagesName) {
  const Scene scene = scene_with("");
  EXPECT_EQ(scene.box.location, "scene.yaml:4:6");
  EXPECT_EQ(scene.stages[0].fill->location, "scene.yaml:10:30");
  EXPECT_EQ(scene.output.frames->location, "scene.yaml:12:18");
}

TEST(Parse, TakesFilesWithTheLineEndsOfOtherSystems) {
  std::string text;
  for (const char letter : testing::small_scene()) {
    text += letter == '\n' ? "\r\n" : std::string(1, letter);
  }
  EXPECT_EQ(to_yaml(parse(text, "a.yaml")), to_yaml(parse(testing::small_scene(), "a.yaml")));
}

TEST(Parse, TakesTabsInComments) {
  EXPECT_NO_THROW(parse("# a\tb\n" + testing::small_scene() + "#\tend", "a.yaml"));
}

TEST(Parse, TakesABoxOfAMillionColumnsAndRowsWithoutVisitingItsSites) {
  const Scene scene = scene_with(
      "box: {width: 866025, height: 1000000}\n"
      "walls: {a: {box: [0, 0, 866025, 1000000]}, b: {line: {from: [0, 0], to: [866025, 1e6]}}}");
  EXPECT_EQ(scene.walls.size(), 2);
}

TEST(ParseFile, SaysWhyAFileCannotBeRead) {
  const clca::testing::ScratchFolder folder;
  EXPECT_THAT(refusal_of_file(folder.path()),
              HasSubstr("1:1: error: cannot read the file: it is a folder"));
  const std::filesystem::path missing = folder.path() / "missing.yaml";
  EXPECT_EQ(refusal_of_file(missing),
            missing.string() + ":1:1: error: cannot read the file: No such file or directory");
}

TEST(ParseFile, ReadsWhatParseReads) {
  const clca::testing::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "scene.yaml";
  std::ofstream(file) << testing::small_scene();
  EXPECT_EQ(to_yaml(parse_file(file)), to_yaml(parse(testing::small_scene(), "scene.yaml")));
}

TEST(Parse, ProbesAndLinesHaveASeriesUnlessItIsNone) {
  for (const char* observed :
       {"probes: {neck: [0, 0, 10, 10]}", "lines: {throat: {from: [0, 5], to: [9, 5]}}"}) {
    const std::string text(observed);
    EXPECT_EQ(scene_with(text + "\noutput: {}").output.series->every, 1) << text;
    EXPECT_EQ(scene_with(text + "\noutput: {series: {every: 7}}").output.series->every, 7);
  }
  EXPECT_FALSE(scene_with("output: {}").output.series);
}

TEST(Parse, NamesOfFilesHaveTheDigitsOfTheLastStep) {
  const auto digits = [](const std::string& stages) {
    return step_digits(scene_with("stages: [" + stages + "]"));
  };
  const std::string first =
      "{name: a, fill: {region: [0, 0, 50, 50], counts: {small: 5}}, "
      "sources: [spout], until: ";
  EXPECT_EQ(digits(first + "{steps: 9}}"), 6);
  EXPECT_EQ(digits(first + "settled}"), 6);
  EXPECT_EQ(digits(first + "{steps: 999999}}"), 6);
  EXPECT_EQ(digits(first + "{steps: 999999}}, {name: b, until: {steps: 1}}"), 7);
  EXPECT_EQ(digits(first + "settled, max_steps: 20000000}"), 8);
}

}  // namespace clca::scene::parse_test
