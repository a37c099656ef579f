// Scenes of the contact model: from text to values and back.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/units.hpp"

namespace clca::scene::contact_test {

namespace {

using contact::Parameters;
using contact::Rolling;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

Scene contact_with(std::string_view part, const std::vector<Override>& overrides = {}) {
  return parse(testing::contact_with(part), "scene.yaml", overrides);
}

std::string refusal(std::string_view part, const std::vector<Override>& overrides) {
  try {
    contact_with(part, overrides);
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

constexpr std::string_view kEverything =
    "species: {bar: {shape: {rod: {radius: 0, length: 3}}}}\n"
    "contact: {friction: 16384, wall_friction: 0, rolling: none, rolling_friction: 1e-3,"
    " restitution: 0.99, sweeps: 64, resolution: 0.5, fall_height: 1e5}\n"
    "walls: {left: {box: [0, 0, 1, 50], friction: 0.25}, right: {box: [50, 0, 51, 50]}}\n"
    "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {bar: 5}}, sources: [spout]}]\n"
    "output: {contacts: none}\n";

}  // namespace

TEST(ParseContact, IsTheAutomatonUnlessTheSceneSaysOtherwise) {
  const Scene scene = parse(testing::small_scene(), "scene.yaml");
  EXPECT_EQ(scene.model, Model::automaton);
  EXPECT_EQ(to_yaml(scene), to_yaml(parse(testing::scene_with("model: automaton"), "scene.yaml")));
}

TEST(ParseContact, BoundsAStageByTheStepsOfItsCycles) {
  const auto bound = [](const std::string& shake) {
    return contact_with(
               "walls: {plate: {box: [0, 0, 50, 1], motion: {shake: " + shake +
               "}}}\nstages: [{name: first, fill: {region: [0, 2, 50, 50], counts: {small: 5}}, "
               "sources: [spout], move: [plate], until: {cycles: 20000}}]\n")
        .stages[0]
        .max_steps;
  };
  EXPECT_EQ(bound("{amplitude: 4}"), 20'000U * (8 * 10 + 60));
  EXPECT_EQ(bound("{amplitude: 4, period: 7, wait: 3}"), 20'000U * (8 * 7 + 3));
}

TEST(ParseContact, FillsInTheDefaults) {
  const Scene scene = contact_with("");
  EXPECT_EQ(scene.model, Model::contact);
  EXPECT_EQ(scene.contact_parameters, Parameters());
  EXPECT_EQ(scene.contact_parameters, contact_with("contact: {}").contact_parameters);
  EXPECT_EQ(scene.automaton_rules, automaton::Rules());
  EXPECT_FALSE(scene.walls[0].friction.has_value());
}

TEST(ParseContact, ReadsEveryKey) {
  const Scene scene = contact_with(kEverything);
  EXPECT_EQ(scene.contact_parameters, (Parameters{.friction = 16384,
                                                  .wall_friction = 0,
                                                  .rolling = Rolling::none,
                                                  .rolling_friction = 1e-3,
                                                  .restitution = 0.99,
                                                  .sweeps = 64,
                                                  .resolution = 0.5,
                                                  .fall_height = 1e5}));
  EXPECT_EQ(scene.walls[0].friction, 0.25);
  EXPECT_FALSE(scene.walls[1].friction.has_value());
}

TEST(ParseContact, TakesAutoForAHeightThatIsEstimated) {
  EXPECT_EQ(contact_with("contact: {fall_height: auto}").contact_parameters.fall_height, 0);
}

TEST(ParseContact, KnowsAHexagonHoweverItIsGiven) {
  for (const std::string_view shape :
       {"hexagon: 0", "rod: {radius: 2, length: 1}",
        "sites: [[4, 4], [4, 5], [5, 4], [5, 3], [4, 3], [3, 4], [3, 5]]",
        "polygon: [[2, 0], [0, 2], [-2, 2], [-2, 0], [0, -2], [2, -2]]"}) {
    const std::string species = "species: {small: {shape: {" + std::string(shape) + "}}}";
    EXPECT_NO_THROW(contact_with(species + "\ncontact: {rolling: free}")) << shape;
  }
}

TEST(ParseContact, TakesTheScenesOfTheAutomatonWithoutRulesOrMotion) {
  const auto folder = std::filesystem::path(CLCA_SOURCE_DIR) / "scenes";
  const Scene scene = parse_file(folder / "wall-removal.yaml", {"model=contact"});
  EXPECT_EQ(scene.model, Model::contact);
  EXPECT_EQ(scene.contact_parameters, Parameters());
}

TEST(ParseContact, TakesOverrides) {
  EXPECT_EQ(contact_with("", {"contact.friction=0.1"}).contact_parameters.friction, 0.1);
  EXPECT_EQ(contact_with("", {"walls.left.friction=0.1"}).walls[0].friction, 0.1);
  const Scene scene = contact_with("contact: {fall_height: 9}", {"contact.fall_height=auto"});
  EXPECT_EQ(to_yaml(scene), to_yaml(contact_with("")));
}

TEST(ParseContact, NamesAnOverrideThatTheModelDoesNotHave) {
  EXPECT_EQ(refusal("", {"rules.inertia=0"}),
            "--set rules.inertia=0: error: rules: only model automaton has it; remove it, or say "
            "'model: automaton'");
  EXPECT_EQ(refusal("", {"model=automaton", "contact.sweeps=4"}),
            "--set contact.sweeps=4: error: contact: only model contact has it; remove it, or say "
            "'model: contact'");
}

TEST(ParseContact, DrawsArrowsWhereTheVesselGoesThroughCycles) {
  const std::string arrows = "output.frames={overlay: arrows}";
  const Scene shaken =
      contact_with("", {arrows, "stages.first.vessel={shake: {gamma: 2, amplitude: 5}}",
                        "stages.first.until={cycles: 2}"});
  EXPECT_EQ(shaken.output.frames->overlay, Overlay::arrows);
  EXPECT_THAT(refusal("", {arrows, "stages.first.vessel={tilt: {to: 20, rate: 1}}"}),
              HasSubstr("output.frames.overlay: no arrows without a stage"));
}

TEST(ParseContact, GivesAStageAsManyStepsAsItsCyclesTake) {
  const auto turning = [](double rate, const std::vector<Override>& more = {}) {
    std::vector<Override> overrides = {
        fmt::format("stages.first.vessel={{rotate: {{rate: {}}}}}", rate),
        "stages.first.until={cycles: 3}"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return contact_with("", overrides);
  };
  EXPECT_EQ(turning(-0.01).stages.front().max_steps, 1'000'000U) << "the default is more";
  const Scene slow = turning(1e-7);
  const double period = 1e7 / unit_conversion(slow)->time_step;
  EXPECT_NEAR(static_cast<double>(slow.stages.front().max_steps), 3 * period, 1e-6 * period);
  EXPECT_THAT([&] { turning(1e-7, {"stages.first.max_steps=1000"}); },
              ThrowsMessage<SceneError>(HasSubstr("1000 is less than the ")));
}

TEST(ParseContact, AveragesForcesOverAWindow) {
  EXPECT_FALSE(contact_with("").output.contacts);
  const ContactSampling contacts =
      contact_with("", {"output.contacts={every: 2, window: 50}"}).output.contacts.value();
  EXPECT_EQ(contacts.every, 2U);
  EXPECT_EQ(contacts.window_steps, 50U);
  EXPECT_EQ(contact_with("", {"output.contacts={}"}).output.contacts->window_steps, 100U);
  const Scene scene = contact_with("", {"output.contacts={every: 2, window: 50}"});
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

TEST(ParseContact, TheAutomatonHasNoWindow) {
  const auto folder = std::filesystem::path(CLCA_SOURCE_DIR) / "scenes";
  try {
    parse_file(folder / "piston.yaml", {"output.contacts.window=5"});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), HasSubstr("output.contacts.window: only model contact has it"));
  }
}

TEST(ParseContact, ToYamlAndBackIsTheSameScene) {
  for (const std::string_view part : {std::string_view(""), kEverything}) {
    const Scene scene = contact_with(part);
    EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
  }
}

TEST(ParseContact, ToYamlShowsEveryDefaultAndNoRules) {
  const std::string text = to_yaml(contact_with(""));
  EXPECT_THAT(text, HasSubstr("seed: 1\nmodel: contact\nbox:"));
  EXPECT_THAT(text, HasSubstr("\n\n"
                              "contact:\n"
                              "  friction: 0.4\n"
                              "  wall_friction: 0.4\n"
                              "  rolling: resistance\n"
                              "  rolling_friction: 0.5\n"
                              "  restitution: 0.4\n"
                              "  sweeps: 2\n"
                              "  resolution: 0.4\n"
                              "  fall_height: auto\n"
                              "\n"
                              "walls:\n"
                              "  left: {box: [0, 0, 1, 50]}\n"));
  EXPECT_THAT(text, Not(HasSubstr("rules:")));
  EXPECT_THAT(to_yaml(contact_with("walls: {left: {box: [0, 0, 1, 50], friction: 0.25}}")),
              HasSubstr("  left: {box: [0, 0, 1, 50], friction: 0.25}\n"));
}

TEST(ParseContact, ScenesDifferWhenAPartOfTheModelDiffers) {
  const Scene scene = contact_with("");
  for (const std::string_view part :
       {"model: automaton", "contact: {friction: 0.5}", "contact: {wall_friction: 0.5}",
        "contact: {rolling: free}", "contact: {rolling_friction: 0.4}", "contact: {restitution: 0}",
        "contact: {sweeps: 4}", "contact: {resolution: 1}", "contact: {fall_height: 50}",
        "walls: {left: {box: [0, 0, 1, 50], friction: 0.4}, right: {box: [50, 0, 51, 50]}}"}) {
    EXPECT_NE(to_yaml(contact_with(part)), to_yaml(scene)) << part;
  }
}

TEST(SizeOf, CountsVelocitiesAndContactsOfTheContactModel) {
  const std::string_view many =
      "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {small: 100}},"
      " sources: [spout]}]";
  const ModelSize size = model_size(contact_with(many));
  EXPECT_GT(size.memory_bytes, model_size(contact_with(many, {"model=automaton"})).memory_bytes +
                                   1000 * static_cast<double>(size.max_particles));
}

}  // namespace clca::scene::contact_test
