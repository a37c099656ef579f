// Units of scenes of the contact model: from text to values and back, and what steps and spacings
// are in them.

#include "clca/scene/units.hpp"

#include <fmt/args.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "bad_scenes.hpp"
#include "clca/contact/contact_model.hpp"
#include "clca/scene/parse.hpp"

namespace clca::scene::units_test {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Scene contact_with(const std::string& part, const std::vector<Override>& overrides = {}) {
  return parse(testing::contact_with(part), "scene.yaml", overrides);
}

double step_gravity(const Scene& scene) {
  return contact::gravity(contact_parameters(scene));
}

constexpr std::string_view kUntilTime =
    "stages: [{name: first, fill: {region: [0, 0, 50, 50], counts: {small: 5}},"
    " sources: [spout], until: {time: 2.5}}]\n";

}  // namespace

TEST(Units, TakeALengthInMetresCentimetresMillimetresOrMicrometres) {
  constexpr auto kLengths = std::to_array<std::pair<std::string_view, double>>({
      {"2 m", 2},
      {"1000 m", 1000},
      {"0.5 cm", 0.005},
      {"1 mm", 0.001},
      {"1mm", 0.001},
      {"\"1.3 mm\"", 0.0013},
      {".5   mm", 0.0005},
      {"1e-3 m", 0.001},
      {"350 um", 0.00035},
      {"0.001 um", 1e-9},
  });
  for (const auto& [text, metres] : kLengths) {
    const Scene scene = contact_with("units: {spacing: " + std::string(text) + "}");
    EXPECT_EQ(scene.units->spacing, metres) << text;
    EXPECT_EQ(scene.units->gravity, 9.81) << text;
  }
}

TEST(Units, TurnLengthsIntoSpacings) {
  constexpr std::string_view kScene =
      "clca: 1\nmodel: contact\nunits: {{spacing: 0.25 mm}}\nbox: {{width: {}, height: {}}}\n"
      "contact: {{fall_height: {}, rolling: none}}\n"
      "species:\n"
      "  brick: {{shape: {{rectangle: [{}, {}]}}}}\n"
      "  ell: {{shape: {{outline: [[-{}, 0], [{}, 0], [0, {}]]}}}}\n"
      "  round: {{shape: {{disc: {}}}}}\n"
      "  sand: {{sizes: {{law: uniform, mean: {}, sd: {}}}}}\n"
      "  two: {{sizes: {{law: list, diameters: [{}, {}], shares: [1, 1]}}}}\n"
      "walls: {{rod: {{line: {{from: [{}, 0], to: [{}, {}], thickness: {}}}}}, drum: {{ring: "
      "{{centre: "
      "[{}, {}], radius: {}, thickness: {}}}}}, rock: {{disc: {{centre: [{}, {}], radius: "
      "{}}}}}}}\n"
      "outlets: {{tray: {{region: [{}, 0, {}, {}]}}}}\n"
      "lines: {{below: {{from: [{}, {}], to: [{}, {}]}}}}\n"
      "stages: [{{name: all, fill: {{method: deposition, region: [0, {}, {}, {}], mix: {{brick: 1, "
      "ell: "
      "1, round: 1, sand: 1, two: 1}}, level: {}}}, vessel: {{shake: {{gamma: 2, amplitude: "
      "{}}}}}, "
      "until: {{steps: 100}}}}]\n"
      "output: {{fields: {{cell: {}}}, frames: {{view: [-{}, 0, {}, {}], velocity_cell: {}}}}}\n";
  constexpr auto kSpacings = std::to_array<double>(
      {240, 480, 120, 6, 10,  3,  4,  5,  2.5, 8,  0.5, 4,   6,   20,  60,  40, 2,  120, 300, 40, 4,
       200, 60,  9,   4, 200, 20, 10, 40, 100, 40, 150, 230, 400, 300, 0.7, 12, 20, 280, 480, 30});
  const auto scene_in = [&](double spacing, std::string_view unit) {
    fmt::dynamic_format_arg_store<fmt::format_context> lengths;
    for (const double length : kSpacings) {
      lengths.push_back(fmt::format("{}{}", length * spacing, unit));
    }
    return to_yaml(parse(fmt::vformat(kScene, lengths), "scene.yaml"));
  };
  const std::string expected = scene_in(1, "");
  EXPECT_EQ(scene_in(0.25, " mm"), expected);
  EXPECT_EQ(scene_in(0.025, "cm"), expected);
  EXPECT_EQ(scene_in(250, " um"), expected);
  EXPECT_EQ(contact_with("units: {spacing: 0.3 mm}\nbox: {width: 100, height: 24.6 mm}").box.height,
            82)
      << "rounded, as 0.0246 / 0.0003 is a little less";
}

// √3/2 mm² of 2.5 kg/m².
TEST(Units, WithADensityHaveTheMassAndTheWeightOfASite) {
  const Scene scene = contact_with("units: {spacing: 1 mm, gravity: 10, density: 2.5}");
  const UnitConversion units = *unit_conversion(scene);
  EXPECT_NEAR(units.site_mass->mass, 2.16506351e-6, 1e-14);
  EXPECT_NEAR(units.site_mass->weight, 2.16506351e-5, 1e-13);
  EXPECT_EQ(units.si_unit(kForceUnit)->name, "N");
  EXPECT_DOUBLE_EQ(units.in_si(2, kMomentUnit), 2 * units.site_mass->weight * 0.001);
  EXPECT_EQ(units.in_si(2, "spacings"), 2);
  EXPECT_FALSE(unit_conversion(contact_with("units: {spacing: 1 mm}"))->si_unit(kForceUnit));
  EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
}

TEST(Units, AreNoneUnlessTheSceneGivesThem) {
  EXPECT_FALSE(contact_with("").units.has_value());
  EXPECT_EQ(contact_with("units: {spacing: 1 m, gravity: 1.62}").units->gravity, 1.62);
}

TEST(Units, ToYamlAndBackAreTheSame) {
  for (const char* units : {"{spacing: 1 mm}", "{spacing: 0.7 um, gravity: 1.62}"}) {
    const Scene scene = contact_with("units: " + std::string(units));
    EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
  }
  EXPECT_THAT(to_yaml(contact_with("units: {spacing: 1 mm}")),
              HasSubstr("\nunits: {spacing: 0.001 m, gravity: 9.81}\n\nwalls:"));
  EXPECT_THAT(to_yaml(contact_with("")), Not(HasSubstr("units")));
}

TEST(Units, TakeOverrides) {
  const std::string expected = to_yaml(contact_with("units: {spacing: 2 mm, gravity: 1.62}"));
  EXPECT_EQ(to_yaml(contact_with("units: {spacing: 1 mm, gravity: 1.62}", {"units.spacing=2mm"})),
            expected);
  EXPECT_EQ(to_yaml(contact_with("", {"units={spacing: 2 mm}", "units.gravity=1.62"})), expected);
}

TEST(UnitConversion, OfASceneWithUnitsIsToMetresAndSeconds) {
  const Scene scene =
      contact_with("units: {spacing: 2 mm, gravity: 5}\ncontact: {fall_height: 80}");
  const UnitConversion units = *unit_conversion(scene);
  EXPECT_EQ(units.length_unit, "m");
  EXPECT_EQ(units.time_unit, "s");
  EXPECT_EQ(units.velocity_unit, "m/s");
  EXPECT_EQ(units.spacing, 0.002);
  // resolution 0.4: 0.001 spacings per step squared, in 2^-20 of a spacing
  EXPECT_NEAR(units.time_step, std::sqrt(0.001 * 0.002 / 5), 1e-3 * units.time_step);
  EXPECT_DOUBLE_EQ(units.time(1000), 1000 * units.time_step);
  // What falls for a second has gained what gravity gives in one.
  const double steps = 1 / units.time_step;
  EXPECT_NEAR(units.velocity(step_gravity(scene) * steps), 5, 1e-12);
}

TEST(UnitConversion, WithoutUnitsIsByTheSpacingAndGravity) {
  const Scene scene = contact_with("contact: {fall_height: 80}");
  const UnitConversion units = *unit_conversion(scene);
  EXPECT_EQ(units.length_unit, "spacing");
  EXPECT_EQ(units.time_unit, "√(spacing/gravity)");
  EXPECT_EQ(units.velocity_unit, "√(spacing·gravity)");
  EXPECT_EQ(units.spacing, 1);
  EXPECT_EQ(units.time_step, std::sqrt(step_gravity(scene)));
  EXPECT_NEAR(units.velocity(step_gravity(scene) / units.time_step), 1, 1e-12);
}

TEST(UnitConversion, IsNoneForTheAutomaton) {
  EXPECT_FALSE(unit_conversion(parse(testing::small_scene(), "scene.yaml")).has_value());
}

TEST(UnitConversion, WritesTimesWithDecimalsThatTellStepsApart) {
  UnitConversion units = {.length_unit = "m", .time_unit = "s", .velocity_unit = "m/s"};
  const auto text = [&](double time_step, std::uint64_t steps) {
    units.time_step = time_step;
    return units.time_text(steps);
  };
  EXPECT_EQ(text(0.0004, 781), "0.3124 s");
  EXPECT_EQ(text(0.0004, 0), "0.0000 s");
  EXPECT_EQ(text(0.03, 11), "0.33 s");
  EXPECT_EQ(text(2, 11), "22 s");
  EXPECT_EQ(text(1e-300, 1), "0.000000000000 s");
}

TEST(UntilTime, TakesTheStepsThatItNeedsRoundedUp) {
  const UnitConversion units = {
      .length_unit = "m", .time_unit = "s", .velocity_unit = "m/s", .time_step = 0.1};
  EXPECT_EQ(steps_until(0.25, units), 3);
  EXPECT_EQ(steps_until(0.001, units), 1);
  for (std::uint64_t steps = 1; steps < 1000; ++steps) {
    EXPECT_EQ(steps_until(units.time(steps), units), static_cast<double>(steps));
  }
  const Scene scene = contact_with("contact: {fall_height: 80}\n" + std::string(kUntilTime));
  const auto& until = std::get<UntilTime>(scene.stages[0].until);
  EXPECT_EQ(until.time, 2.5);
  EXPECT_EQ(until.steps, 80);
  EXPECT_EQ(fixed_steps(scene.stages[0].until), 80U);
  const Scene real = contact_with("contact: {fall_height: 80}\nunits: {spacing: 1 cm}\n" +
                                  std::string(kUntilTime));
  EXPECT_EQ(fixed_steps(real.stages[0].until),
            static_cast<std::uint64_t>(std::ceil(2.5 / unit_conversion(real)->time_step)));
}

TEST(DerivedMeasure, MayNameTheSpacingWhichIsInMetres) {
  const Scene scene = contact_with("units: {spacing: 2 mm}\nmeasure: {e: =3*units.spacing}\n");
  EXPECT_EQ(scene.derived_measures.front().expression, "=3*0.002");
}

TEST(UntilTime, ToYamlAndBackIsTheSame) {
  for (const char* units : {"", "units: {spacing: 1 mm}\n"}) {
    const Scene scene = contact_with(units + std::string(kUntilTime));
    EXPECT_THAT(to_yaml(scene), HasSubstr("until: {time: 2.5}"));
    EXPECT_EQ(testing::reparsed(scene), to_yaml(scene));
  }
}

TEST(UntilTime, RaisesTheBoundOnSteps) {
  const Scene scene = contact_with("units: {spacing: 1 um}\n" + std::string(kUntilTime),
                                   {"stages.first.until.time=1000"});
  EXPECT_GT(*fixed_steps(scene.stages[0].until), 1'000'000U);
  EXPECT_EQ(scene.stages[0].max_steps, *fixed_steps(scene.stages[0].until));
}

}  // namespace clca::scene::units_test
