#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/parse.hpp"

namespace clca::scene::override_test {

namespace {

constexpr std::string_view kTwoStages =
    "stages:\n"
    "  - {name: first, sources: [spout], until: {steps: 9}}\n"
    "  - {name: flow, remove: [right], until: settled}\n";

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
    {"rule.inertia=1",
     "unknown key 'rule' (allowed: clca, let, title, seed, model, begin, box, species, rules, "
     "contact, "
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
     "segregation, intruder, convection, found 'profil'; "
     "did you mean 'profile'?"},
    {"seed=[1", "the '[' is not closed, or a ',' is missing after it"},
    {"seed=&a 1", "anchors ('&') are not part of the format"},
    {"box={width: 1, width: 2}", "duplicate key 'width'"},
    {"species.small.color=#ff0000",
     "species.small.color: expected a colour like \"#3a6ea5\", in quotes, found nothing"},
});

}  // namespace

TEST(Override, ReplacesAValue) {
  EXPECT_EQ(overridden({"rules.inertia=0.5"}).rules.inertia, 0.5);
  EXPECT_EQ(overridden({"box={width: 99, height: 60}"}).box, (Box{99, 60, false, {}}));
}

TEST(Override, AddsAKey) {
  EXPECT_EQ(overridden({"rules.scatter=1"}).rules.scatter, 1);
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
  EXPECT_EQ(overridden({"stages.flow.until.steps=50"}).stages[1].until, Until(UntilSteps{50}));
  EXPECT_EQ(overridden({"stages.first.until.discharged=1"}).stages[0].until,
            Until(UntilDischarged{1}));
}

TEST(Override, PutsAShapeInPlaceOfAnother) {
  const Scene scene = overridden({"species.small.shape.rod={radius: 0, length: 3}"});
  EXPECT_EQ(scene.species[0].shape_spec, ShapeSpec(RodSpec{0, 3}));
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

TEST(Override, WithAnErrorNamesItself) {
  for (const BadOverride& bad : kBad) {
    const std::string text(bad.text);
    EXPECT_EQ(refusal({text}), "--set " + text + ": error: " + std::string(bad.message));
  }
}

}  // namespace clca::scene::override_test
