#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/parse.hpp"
#include "scene/sections.hpp"

namespace clca::scene::override_test {

namespace {

constexpr std::string_view kTwoStages =
    "stages:\n"
    "  - {name: first, sources: [spout], until: {steps: 9}}\n"
    "  - {name: flow, remove: [right], until: settled}\n";

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Scene overridden(const std::vector<Override>& overrides) {
  return parse(testing::scene_with(kTwoStages), "scene.yaml", overrides);
}

std::string refusal(const std::vector<Override>& overrides) {
  try {
    overridden(overrides);
    return "accepted";
  } catch (const SceneError& error) {
    return error.what();
  }
}

struct BadOverride {
  std::string_view text;
  std::string_view message;  ///< after `--set TEXT: error: `
};

constexpr auto kBad = std::to_array<BadOverride>({
    {"rules.inertia", "expected KEY=VALUE with a key like rules.inertia"},
    {"=1", "expected KEY=VALUE with a key like rules.inertia"},
    {"rules..inertia=1", "expected KEY=VALUE with a key like rules.inertia"},
    {"rules.=1", "expected KEY=VALUE with a key like rules.inertia"},
    {"rules.inertai=1",
     "unknown key 'inertai' in rules (allowed: inertia, scatter, candidates, gravity, "
     "update_priority, ties); did you mean 'inertia'?"},
    {"let.inertia=1", "nothing is called 'inertia' under let"},
    {"rule.inertia=1",
     "unknown key 'rule' (allowed: clca, let, title, seed, model, begin, box, species, rules, "
     "contact, voids, baxter, "
     "units, "
     "walls, "
     "sources, outlets, probes, lines, stages, measure, output); did you mean 'rules'?"},
    {"rules={inertia: 2}", "rules.inertia: expected a number from 0 to 1, found '2'"},
    {"rules.inertia=much", "rules.inertia: expected a number from 0 to 1, found 'much'"},
    {"rules.inertia=", "rules.inertia: expected a number from 0 to 1, found nothing"},
    {"title.first=x", "title is 'Test', nothing lies inside it; set it as a whole"},
    {"stages.7.name=x", "stages has no item '7'; it has 2, numbered from 0, named first, flow"},
    {"stages.flwo.until=settled",
     "stages has no item 'flwo'; it has 2, numbered from 0, named first, flow; did you mean "
     "'flow'?"},
    {"stages.flow.until=setled",
     "stages.flow.until: expected settled, {steps: N}, {discharged: SHARE}, {cycles: N} or {time: "
     "T}, "
     "found 'setled'; did you mean 'settled'?"},
    {"measure.0=profil",
     "measure: expected one of profile, repose, runout, packing, moved, outflow, force, "
     "segregation, intruder, convection, axis_order, mixing, weight_paths, found 'profil'; "
     "did you mean 'profile'?"},
    {"seed=[1", "the '[' is not closed, or a ',' is missing after it"},
    {"seed=&a 1", "anchors ('&') are not part of the format"},
    {"box={width: 1, width: 2}", "duplicate key 'width'"},
    {"species.small.color=#ff0000",
     "species.small.color: expected a colour like \"#3a6ea5\", in quotes, found nothing"},
});

}  // namespace

TEST(Override, ReplacesAValue) {
  EXPECT_EQ(overridden({"rules.inertia=0.5"}).automaton_rules.inertia, 0.5);
  const Box box = overridden({"box={width: 99, height: 60}"}).box;
  EXPECT_EQ(box.width, 99);
  EXPECT_EQ(box.height, 60);
  EXPECT_FALSE(box.periodic);
}

TEST(Override, AddsAKey) {
  EXPECT_EQ(overridden({"rules.scatter=1"}).automaton_rules.scatter, 1);
  EXPECT_EQ(overridden({"walls.new={box: [9, 0, 12, 9]}"}).walls.back().name, "new");
  EXPECT_EQ(overridden({"output.frames.view=[0, 0, 9, 9]"}).output.frames->every, 10);
}

TEST(Override, AddsTheMapsOnTheWay) {
  const std::string text = testing::scene_with("output: {}");
  EXPECT_EQ(parse(text, "a.yaml", {"output.frames.every=7"}).output.frames->every, 7);
}

TEST(Override, FindsStagesByNumberAndByName) {
  EXPECT_EQ(overridden({"stages.1.max_steps=9"}).stages[1].max_steps, 9);
  EXPECT_EQ(overridden({"stages.flow.max_steps=9"}).stages[1].max_steps, 9);
}

TEST(Override, PutsAnEndInPlaceOfAnother) {
  const EndCondition by_steps = overridden({"stages.flow.until.steps=50"}).stages[1].until;
  EXPECT_EQ(std::get<UntilSteps>(by_steps).steps, 50);
  const EndCondition by_share = overridden({"stages.first.until.discharged=1"}).stages[0].until;
  EXPECT_EQ(std::get<UntilDischarged>(by_share).discharged_share, 1);
}

TEST(Override, PutsAMotionOfTheVesselInPlaceOfAnother) {
  const Scene scene = parse(R"(clca: 1
model: contact
box: {width: 20, height: 20}
species: {a: {shape: {hexagon: 1}}}
stages:
  - {name: s, fill: {region: [0, 0, 20, 20], counts: {a: 3}}, vessel: {tilt: 5}, until: {steps: 9}}
output: {}
)",
                            "scene", {"stages.s.vessel.rotate.rate=0.001"});
  EXPECT_THAT(to_yaml(scene), AllOf(HasSubstr("rotate:"), Not(HasSubstr("tilt:"))));
}

TEST(Override, PutsAShapeInPlaceOfAnother) {
  const Scene scene = overridden({"species.small.shape.rod={radius: 0, length: 3}"});
  EXPECT_EQ(std::get<RodSpec>(scene.species[0].shape_spec).length, 3);
}

TEST(Override, TheLastOneCounts) {
  EXPECT_EQ(overridden({"seed=5", "seed=6"}).seed, 6);
}

TEST(Override, MayHoldAnEqualsSign) {
  EXPECT_EQ(overridden({"title=a=b"}).title, "a=b");
}

TEST(Override, LeavesErrorsElsewhereAtTheirPlaceInTheFile) {
  const std::string text = testing::scene_with("measure: [profil]");
  try {
    parse(text, "scene.yaml", {"rules.inertia=0"});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), ::testing::StartsWith("scene.yaml:11:11: error: measure: "));
  }
}

TEST(Override, MayNotNestWithoutBound) {
  std::string deep = "a";
  for (int i = 0; i < 50'000; ++i) {
    deep += ".a";
  }
  EXPECT_TRUE(refusal({deep + "=1"}).ends_with("=1: error: a key of more than 32 parts"));
}

TEST(Override, MayNotHoldAValueThatNestsWithoutBound) {
  EXPECT_TRUE(refusal({"rules=" + std::string(50'000, '[')})
                  .ends_with("error: nested deeper than 32 levels"));
}

TEST(Override, IsShortenedInItsErrors) {
  const std::string message = refusal({"title=" + std::string(100'000, 'x')});
  EXPECT_LT(message.size(), 300U) << message;
  EXPECT_THAT(message, ::testing::StartsWith("--set title=xxx"));
}

TEST(Override, OfNoneLeavesOutAKeyWhoseDefaultIsNone) {
  const Scene scene = overridden({"walls=none", "outlets=none", "stages.flow.remove=none"});
  EXPECT_TRUE(scene.walls.empty());
  EXPECT_TRUE(scene.outlets.empty());
  EXPECT_FALSE(overridden({"stages.flow.fill=none"}).stages[1].fill);
  EXPECT_FALSE(refusal({"species=none"}).empty());
  EXPECT_FALSE(refusal({"walls='none'"}).empty());
}

// Whatever else is wrong with it in this scene, such as a map that lacks other keys.
TEST(Override, OfADefaultThatIsExplainedIsAValueOfTheKey) {
  int checked = 0;
  const auto check = [&](const auto& self, const AnyKeys& keys, const std::string& above,
                         bool is_gas) -> void {
    for (const AnyKey& key : *keys) {
      const std::string path = above + key.name;
      const std::string text = explanation((is_gas ? "boltzmann:" : "") + path);
      const std::string first = text.substr(0, text.find("\n", text.find('\n') + 1));
      constexpr std::string_view kDefault = "; default: ";
      if (const std::size_t at = first.find(kDefault); at != std::string::npos) {
        const std::string set = path + "=" + first.substr(at + kDefault.size());
        const std::string scene = is_gas                         ? testing::small_gas()
                                  : !key.model                   ? testing::small_scene()
                                  : *key.model == Model::contact ? testing::small_contact()
                                                                 : testing::small_scene();
        try {
          parse_any(scene, "scene.yaml", {set});
        } catch (const SceneError& error) {
          EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr(path + ": expected")))
              << set;
        }
        ++checked;
      }
      if (key.type->keys != nullptr) {
        self(self, key.type->keys, path + (key.type->is_collection ? ".first." : "."), is_gas);
      }
    }
  };
  check(check, scene_type().keys, "", false);
  check(check, boltzmann_type().keys, "", true);
  EXPECT_GT(checked, 60);
}

TEST(Override, OfAKeyThatStandsElsewhereNamesItsPlace) {
  for (const auto& [text, path] :
       std::map<std::string, std::string>{{"friction=0.3", "contact.friction"},
                                          {"inertia=0.3", "rules.inertia"},
                                          {"rules.friction=0.3", "contact.friction"},
                                          {"inertai=0.3", "rules.inertia"}}) {
    EXPECT_THAT(refusal({text}), ::testing::EndsWith("; did you mean '" + path + "'?"));
  }
  EXPECT_THAT(refusal({"rules.inerta=0"}), ::testing::EndsWith("; did you mean 'inertia'?"));
}

TEST(Override, WithAnErrorNamesItself) {
  for (const BadOverride& bad : kBad) {
    const std::string text(bad.text);
    EXPECT_EQ(refusal({text}), "--set " + text + ": error: " + std::string(bad.message));
  }
}

TEST(Override, WithAnErrorNamesTheOptionThatStandsForIt) {
  EXPECT_THAT(refusal({{"seed=x", "--start x"}}), ::testing::StartsWith("--start x: error: "));
}

}  // namespace clca::scene::override_test
