// Numbers with names, and expressions in the place of numbers.

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "bad_scenes.hpp"
#include "clca/scene/output.hpp"
#include "clca/scene/parse.hpp"

namespace clca::scene::let_test {

namespace {

constexpr std::string_view kLet =
    "let: {L0: 30, gate: =L0 + 1, pull: 0.5}\n"
    "rules: {inertia: =pull/4}\n"
    "walls: {right: {box: [=gate, 0, =gate + 1, 50]}}\n"
    "box: {width: =4*L0, height: \"=max(3*L0, 10, 20)\"}\n";

Scene scene_of(std::string_view part, const std::vector<Override>& overrides = {}) {
  return parse(testing::scene_with(part), "scene.yaml", overrides);
}

TEST(Let, NamesANumberForExpressionsWhereverANumberStands) {
  const Scene scene = scene_of(kLet);
  EXPECT_EQ(scene.box.width, 120);
  EXPECT_EQ(scene.box.height, 90);
  EXPECT_EQ(scene.automaton_rules.inertia, 0.125);
}

TEST(Let, IsSetByItsNameAndMovesAllThatDependsOnIt) {
  for (const char* name : {"L0=40", "let.L0=40", "L0==20*2"}) {
    const Scene scene = scene_of(kLet, {name});
    EXPECT_EQ(scene.box.width, 160) << name;
    EXPECT_EQ(scene.box.height, 120) << name;
  }
  EXPECT_EQ(scene_of(kLet, {"rules.inertia==pull/2"}).automaton_rules.inertia, 0.25);
}

TEST(Let, TheResolvedSceneHasTheNumbers) {
  const std::string text = to_yaml(scene_of(kLet));
  EXPECT_NE(text.find("box: {width: 120, height: 90"), std::string::npos) << text;
  EXPECT_EQ(text.find("\nlet:"), std::string::npos);
}

TEST(Let, LargeWholeNumbersHaveNoExponent) {
  EXPECT_EQ(scene_of("seed: =10^15").seed, 1000000000000000U);
  EXPECT_EQ(scene_of("seed: =-0").seed, 0U);
}

TEST(Let, ConstantsHaveAllTheirDigits) {
  EXPECT_EQ(scene_of("rules: {inertia: =_pi/4}").automaton_rules.inertia, std::numbers::pi / 4);
  EXPECT_EQ(scene_of("rules: {inertia: =_e/4}").automaton_rules.inertia, std::numbers::e / 4);
}

TEST(Derived, HasTheNumbersOfNamesAndOfKeysInItsExpression) {
  constexpr std::string_view kPart =
      "let: {L0: 30, power: -2}\n"
      "measure: {ratio: =runout_99 / L0 ^ power,\n"
      "          twice: {value: '=min(2*ratio, 1e-3)', unit: spacings, about: Twice it},\n"
      "          walls: =box.width*rules.inertia + discharged.drain}\n";
  const Scene scene = scene_of(kPart);
  ASSERT_EQ(scene.derived_measures.size(), 3U);
  EXPECT_EQ(scene.derived_measures[0].expression, "=runout_99 / 30 ^ (-2)");
  EXPECT_EQ(scene.derived_measures[0].unit, "1");
  EXPECT_EQ(scene.derived_measures[1].expression, "=min(2*ratio, 1e-3)");
  EXPECT_EQ(scene.derived_measures[1].about, "Twice it");
  EXPECT_EQ(scene.derived_measures[2].expression, "=100*0.9 + discharged.drain");
  EXPECT_EQ(scene.measures.size(), 11U) << "beside all others";
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

TEST(Derived, StandsInTheListOfMeasuresToo) {
  const Scene scene = scene_of("measure: [runout, {ratio: =runout_99 / 3}, {half: =ratio / 2}]");
  EXPECT_EQ(scene.measures, std::vector{Measure::runout});
  ASSERT_EQ(scene.derived_measures.size(), 2U);
  EXPECT_EQ(scene.derived_measures[1].name, "half");
  EXPECT_EQ(scene_of("measure: [runout]", {"measure={ratio: =runout_99}"}).derived_measures.size(),
            1U);
}

TEST(Let, ATitleMayBeginWithAnEqualsSign) {
  EXPECT_EQ(scene_of("title: =L0 is text").title, "=L0 is text");
}

TEST(Let, AGasHasItToo) {
  const AnyScene any = parse_any(testing::gas_with("let: {n: 40}\nseed: =n^2\n"), "gas.yaml");
  EXPECT_EQ(std::get<BoltzmannScene>(any).seed, 1600U);
}

}  // namespace
}  // namespace clca::scene::let_test
