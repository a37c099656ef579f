// Walls that move: from text to values and back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/walls.hpp"

namespace clca::scene::motion_test {

namespace {

using grains::WallMotion;
using lattice::Direction;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Scene scene_with(std::string_view part) {
  Scene scene = parse(testing::scene_with(part), "scene.yaml");
  check_walls(scene);
  return scene;
}

/// A plate that moves in the only stage, for 9 steps.
std::string plate(const std::string& motion) {
  return "walls: {plate: {box: [10, 40, 20, 42], " + motion +
         "}}\n"
         "stages: [{name: first, sources: [spout], move: [plate], until: {steps: 9}}]\n";
}

WallMotion motion_of(const std::string& motion) {
  return *scene_with(plate("motion: " + motion)).walls[0].motion;
}

constexpr std::string_view kTray =
    "walls:\n"
    "  tray:\n"
    "    parts: [{box: [0, 0, 100, 2]}, {line: {from: [0, 2], to: [0, 60]}}]\n"
    "    motion: {shake: {amplitude: 2}}\n"
    "    passive: overlap\n"
    "  lid: {box: [10, 80, 20, 90], motion: {direction: down, period: 4, distance: 40}}\n"
    "  gate: {box: [50, 30, 51, 40]}\n"
    "stages:\n"
    "  - {name: first, sources: [spout], insert: [lid], move: [tray, lid], until: {cycles: 3}}\n"
    "  - {name: second, remove: [lid, gate], move: [tray], max_steps: 50}\n"
    "  - {name: third, insert: [gate, lid], move: [], until: settled}\n"
    "measure: [force, segregation, intruder, convection]\n"
    "output:\n"
    "  frames: {color_by: force, overlay: arrows}\n"
    "  fields: {cell: 2.5}\n"
    "  contacts: {every: 3}\n";

}  // namespace

TEST(ParseMotion, ReadsADriveOneSiteAStepUnlessThePeriodSaysOtherwise) {
  EXPECT_EQ(motion_of("{direction: down, distance: 30}"),
            (WallMotion{Direction::down, grains::Drive{1, 30}}));
  EXPECT_EQ(motion_of("{direction: up_left, period: 4, distance: 1000000}"),
            (WallMotion{Direction::up_left, grains::Drive{4, 1'000'000}}));
}

TEST(ParseMotion, ReadsWavesDownToTheShortestPeriod) {
  EXPECT_EQ(motion_of("{wave: {amplitude: 2, period: 14}}"),
            (WallMotion{Direction::up, grains::Wave{grains::Waveform::sine, 2, 14}}));
  EXPECT_EQ(motion_of("{direction: down_left, wave: {form: triangle, amplitude: 3, period: 12}}"),
            (WallMotion{Direction::down_left, grains::Wave{grains::Waveform::triangle, 3, 12}}));
}

TEST(ParseMotion, TheWidestAndLongestWaveStaysWithinItsAmplitude) {
  const WallMotion motion = motion_of("{wave: {amplitude: 10000, period: 10000000}}");
  const auto& wave = std::get<grains::Wave>(motion.program);
  EXPECT_EQ(grains::target_offset(wave, 2'500'000), 10'000);
  EXPECT_EQ(grains::target_offset(wave, 5'000'000), 0);
  EXPECT_EQ(grains::target_offset(wave, 7'500'000), -10'000);
}

TEST(ParseMotion, ReadsShakesThatWaitUntilSettledOrSoManySteps) {
  EXPECT_EQ(motion_of("{shake: {amplitude: 2}}"),
            (WallMotion{Direction::up, grains::Shake{2, {}}}));
  EXPECT_EQ(motion_of("{shake: {amplitude: 2, wait: settled}}"),
            motion_of("{shake: {amplitude: 2}}"));
  EXPECT_EQ(motion_of("{direction: up_right, shake: {amplitude: 1, wait: 50}}"),
            (WallMotion{Direction::up_right, grains::Shake{1, 50}}));
}

TEST(ParseMotion, ReadsPathsAsSteepAsOneSiteAStep) {
  EXPECT_EQ(motion_of("{path: [[3, 3], [4, 2], [100, -50]]}"),
            (WallMotion{Direction::up, grains::Path{{{3, 3}, {4, 2}, {100, -50}}}}));
}

TEST(ParseMotion, ReadsOneBodyOfSeveralPartsAndItsPassiveRule) {
  const Scene scene = scene_with(kTray);
  const Wall& tray = scene.walls[0];
  ASSERT_EQ(tray.parts.size(), 2U);
  EXPECT_EQ(std::get<lattice::Rectangle>(tray.parts[0]), (lattice::Rectangle{0, 0, 100, 2}));
  EXPECT_EQ(std::get<lattice::Segment>(tray.parts[1]), (lattice::Segment{{0, 2}, {0, 60}, 1}));
  EXPECT_EQ(tray.passive_rule, grains::PassiveRule::overlap);
  EXPECT_EQ(tray.location, "scene.yaml:9:5");
  EXPECT_EQ(scene.walls[1].passive_rule, grains::PassiveRule::rigid);
  EXPECT_FALSE(scene.walls[2].motion.has_value());
}

TEST(ParseMotion, ReadsWhatStagesInsertAndMove) {
  const Scene scene = scene_with(kTray);
  EXPECT_THAT(scene.stages[0].inserted_walls, ElementsAre(1));
  EXPECT_EQ(scene.stages[0].insert_location, "scene.yaml:17:45");
  EXPECT_THAT(scene.stages[0].moving_walls, ElementsAre(0, 1));
  EXPECT_EQ(std::get<UntilCycles>(scene.stages[0].until).cycles, 3);
  EXPECT_EQ(scene.stages[0].max_steps, 1'000'000);
  EXPECT_TRUE(scene.stages[1].insert_location.empty());
  EXPECT_TRUE(scene.stages[2].moving_walls.empty());
}

TEST(ParseMotion, ADefaultBoundGivesWayToTheCyclesOfTheLongestWave) {
  const Scene scene = scene_with(
      "walls:\n"
      "  fast: {box: [10, 40, 20, 42], motion: {wave: {amplitude: 1, period: 10}}}\n"
      "  slow: {box: [60, 40, 70, 42], motion: {wave: {amplitude: 1, period: 1000}}}\n"
      "stages: [{name: first, sources: [spout], move: [fast, slow], until: {cycles: 2000}}]");
  EXPECT_EQ(scene.stages[0].max_steps, 2'000'000);
}

TEST(ParseMotion, ReadsNewMeasuresAndOutputs) {
  const Scene scene = scene_with(kTray);
  EXPECT_THAT(scene.measures, ElementsAre(Measure::force, Measure::segregation, Measure::intruder,
                                          Measure::convection));
  EXPECT_EQ(scene.output.frames->color_by, ColorBy::force);
  EXPECT_EQ(scene.output.frames->overlay, Overlay::arrows);
  EXPECT_EQ(scene.output.fields->cell_side, 2.5);
  EXPECT_EQ(scene.output.fields->every, 100);
  EXPECT_EQ(scene.output.contacts->every, 3);
  EXPECT_EQ(scene_with("output: {fields: {}, contacts: none}").output.fields->cell_side, 8);
}

TEST(ParseMotion, ToYamlAndBackIsTheSameScene) {
  for (const std::string& part :
       {std::string(kTray), plate("motion: {direction: down, period: 7, distance: 5}"),
        plate("motion: {direction: down, wave: {amplitude: 1, period: 9}}, passive: overlap"),
        plate("motion: {wave: {form: triangle, amplitude: 1, period: 9}}"),
        plate("motion: {shake: {amplitude: 3, wait: 7}}"),
        plate("motion: {path: [[9, 5], [1000000000000, -1000000]]}")}) {
    const Scene scene = scene_with(part);
    EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
  }
}

TEST(ParseMotion, ToYamlShowsEveryDefaultOfWallsThatMove) {
  const std::string text = to_yaml(scene_with(kTray));
  for (const std::string_view line :
       {"  tray:\n    parts: [{box: [0, 0, 100, 2]}, {line: {from: [0, 2], to: [0, 60], thickness: "
        "1}}]\n    motion: {direction: up, shake: {amplitude: 2, wait: settled}}\n    passive: "
        "overlap\n",
        "  lid: {box: [10, 80, 20, 90], motion: {direction: down, period: 4, distance: 40}, "
        "passive: rigid}\n",
        "  gate: {box: [50, 30, 51, 40]}\n",
        "    insert: [lid]\n    move: [tray, lid]\n    sources: [spout]\n    until: {cycles: 3}\n",
        "    overlay: arrows\n", "  fields: {cell: 2.5, every: 100}\n",
        "  contacts: {every: 3}\n"}) {
    EXPECT_THAT(text, HasSubstr(std::string(line)));
  }
}

TEST(ParseMotion, ScenesDifferWhenAMotionDiffers) {
  const Scene scene = scene_with(plate("motion: {shake: {amplitude: 3}}"));
  for (const std::string_view other :
       {"motion: {shake: {amplitude: 2}}", "motion: {direction: down, shake: {amplitude: 3}}",
        "motion: {shake: {amplitude: 3}}, passive: overlap", "motion: {path: [[3, 3]]}"}) {
    EXPECT_NE(to_yaml(scene_with(plate(std::string(other)))), to_yaml(scene)) << other;
  }
}

}  // namespace clca::scene::motion_test
