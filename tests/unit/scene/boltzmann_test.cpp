// Scenes of the Boltzmann equation: what they say, back to text, and what they need.

#include "clca/scene/boltzmann.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "bad_scenes.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "clca/scene/parse.hpp"

namespace clca::scene::boltzmann_test {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr std::string_view kEverything =
    "title: 'Say \"\\\" in Köln'\n"
    "boltzmann: {particles: 500, initial: equal_energy, exact_moments: false, sampling: quasi,\n"
    "  restitution: [1, 0, 0.8349], friction: 1e-7, roughness: -0.25, energy_ratio: 1e6,\n"
    "  scheme: ogawa-kato, time_step: 1e-3, partners: 7, until: 1e9, ensemble: 12}\n"
    "output: {series: {every: 1e5}, histograms: [], bins: {width: 0.3, end: 15}}\n";

BoltzmannScene gas_with(std::string_view part, const std::vector<Override>& overrides = {}) {
  return std::get<BoltzmannScene>(parse_any(testing::gas_with(part), "folder/gas.yaml", overrides));
}

}  // namespace

TEST(BoltzmannScene, FillsInTheDefaults) {
  const BoltzmannScene scene = std::get<BoltzmannScene>(
      parse_any("clca: 1\nboltzmann: {restitution: 0.5, friction: 0.3}\n", "folder/gas.yaml"));
  BoltzmannScene expected;
  expected.title = "gas";
  expected.restitutions = {0.5};
  expected.friction = 0.3;
  expected.histogram_times = {0, 15};
  expected.checkpoint = CheckpointIntervals{.every_steps = {}, .every_seconds = 60};
  EXPECT_EQ(to_yaml(scene), to_yaml(expected));
  EXPECT_EQ(scene.name, "gas");
  EXPECT_EQ(scene.location, "folder/gas.yaml:2:1");
}

TEST(BoltzmannScene, ReadsEverything) {
  const BoltzmannScene scene = gas_with(kEverything);
  EXPECT_EQ(scene.particles, 500U);
  EXPECT_EQ(scene.initial, boltzmann::InitialDistribution::equal_energy);
  EXPECT_FALSE(scene.exact_moments);
  EXPECT_TRUE(scene.quasi_random);
  EXPECT_THAT(scene.restitutions, ElementsAre(1, 0, 0.8349));
  EXPECT_TRUE(scene.has_restitution_list);
  EXPECT_EQ(scene.friction, 1e-7);
  EXPECT_EQ(scene.roughness, -0.25);
  EXPECT_EQ(scene.energy_ratio, 1e6);
  EXPECT_EQ(scene.scheme, boltzmann::Scheme(boltzmann::OgawaKato{1e-3, 7, true}));
  EXPECT_EQ(scene.end_time, 1e9);
  EXPECT_EQ(scene.ensemble_size, 12U);
  EXPECT_EQ(scene.series_interval, 1e5);
  EXPECT_THAT(scene.histogram_times, IsEmpty());
  EXPECT_EQ(std::get<UniformBins>(scene.bins).width, 0.3);
}

TEST(BoltzmannScene, WithARoughnessAloneSlidesNowhere) {
  const BoltzmannScene scene = gas_with("boltzmann: {restitution: 1, roughness: -1}");
  EXPECT_EQ(scene.friction, boltzmann::kNoSlidingLimit);
  EXPECT_EQ(scene.roughness, -1);
}

TEST(BoltzmannScene, KeepsAListOfOne) {
  EXPECT_TRUE(gas_with("boltzmann: {restitution: [1], friction: 0}").has_restitution_list);
  EXPECT_FALSE(gas_with("boltzmann: {restitution: 1, friction: 0}").has_restitution_list);
}

TEST(BoltzmannScene, TakesTheLastValuesThatAreAllowed) {
  EXPECT_EQ(std::get<QuantileBins>(gas_with("output: {bins: q2}").bins).count, 2);
  EXPECT_EQ(std::get<QuantileBins>(gas_with("output: {bins: q1000}").bins).count, 1000);
  EXPECT_EQ(
      std::get<UniformBins>(gas_with("output: {bins: {width: 15, end: 15}}").bins).last_bin_start,
      15);
  const BinsSpec narrow = gas_with("output: {bins: {width: 0.0015, end: 15}}").bins;
  EXPECT_EQ(std::get<UniformBins>(narrow).width, 0.0015);
  EXPECT_EQ(gas_with("output: {series: {every: 1.5e-5}}").series_interval, 1.5e-5);
  EXPECT_THAT(gas_with("output: {histograms: [15]}").histogram_times, ElementsAre(15));
}

TEST(BoltzmannScene, HasAtMostAThousandHistograms) {
  std::string times = "0";
  for (int i = 1; i < 1000; ++i) {
    times += fmt::format(", {}", 0.01 * i);
  }
  EXPECT_EQ(gas_with(fmt::format("output: {{histograms: [{}]}}", times)).histogram_times.size(),
            1000U);
  EXPECT_THAT([&] { gas_with(fmt::format("output: {{histograms: [{}, 15]}}", times)); },
              ThrowsMessage<SceneError>(::testing::StrEq(
                  "folder/gas.yaml:5:22: error: output.histograms: expected 0 to 1000 items, "
                  "found 1001")));
}

TEST(BoltzmannScene, TakesOverrides) {
  const BoltzmannScene scene =
      gas_with("", {"boltzmann.restitution=0.9", "boltzmann.scheme=ogawa-kato",
                    "boltzmann.partners=3", "output.bins=q30", "seed=7"});
  EXPECT_THAT(scene.restitutions, ElementsAre(0.9));
  EXPECT_EQ(std::get<boltzmann::OgawaKato>(scene.scheme).partner_count, 3);
  EXPECT_EQ(std::get<QuantileBins>(scene.bins).count, 30);
  EXPECT_EQ(scene.seed, 7U);
}

TEST(BoltzmannScene, WithAnOverrideOfTheOtherKindIsRefusedAtTheOverride) {
  EXPECT_THAT(
      [] { gas_with("", {"rules.inertia=0"}); },
      ThrowsMessage<SceneError>(StartsWith(
          "--set rules.inertia=0: error: 'rules' does not go with 'boltzmann': a scene of the ")));
  EXPECT_THAT(
      [] { parse(testing::small_scene(), "scene.yaml", {"boltzmann.friction=0"}); },
      ThrowsMessage<SceneError>(StartsWith(
          "--set boltzmann.friction=0: error: 'boltzmann' does not go with 'box': a scene of ")));
}

TEST(BoltzmannScene, WithAMisspeltBlockIsStillOne) {
  EXPECT_THAT([] { parse_any("clca: 1\nboltzman: {restitution: 1}\n", "scene.yaml"); },
              ThrowsMessage<SceneError>(::testing::StrEq(
                  "scene.yaml:2:1: error: unknown key 'boltzman' (allowed: clca, let, title, seed, "
                  "boltzmann, output); did you mean 'boltzmann'?")));
}

TEST(BoltzmannScene, IsNoSceneOfTheAutomaton) {
  EXPECT_THAT([] { parse(testing::small_gas(), "scene.yaml"); },
              ThrowsMessage<SceneError>(
                  ::testing::StrEq("scene.yaml:4:1: error: expected a scene of grains, "
                                   "found one of the Boltzmann equation")));
}

TEST(BoltzmannScene, DiffersWhenAnyPartDiffers) {
  const BoltzmannScene scene = gas_with("");
  for (const std::string_view change :
       {"title=Other", "seed=2", "boltzmann.particles=9", "boltzmann.initial=equal_energy",
        "boltzmann.exact_moments=false", "boltzmann.sampling=quasi", "boltzmann.restitution=1",
        "boltzmann.restitution=[0.5]", "boltzmann.friction=0", "boltzmann.roughness=1",
        "boltzmann.energy_ratio=2", "boltzmann.scheme=ogawa-kato", "boltzmann.shear_rate=1",
        "boltzmann.until=16", "boltzmann.ensemble=2", "output.series.every=1",
        "output.histograms=[]", "output.bins=q21"}) {
    EXPECT_NE(to_yaml(gas_with("", {std::string(change)})), to_yaml(scene)) << change;
  }
}

TEST(BoltzmannToYaml, ParsesToTheSameScene) {
  for (const std::string_view part :
       {std::string_view(""), kEverything,
        std::string_view("boltzmann: {restitution: [1], roughness: 0.1, shear_rate: 1}")}) {
    const BoltzmannScene scene = gas_with(part);
    const AnyScene again = parse_any(to_yaml(scene), "gas.yaml");
    EXPECT_EQ(to_yaml(std::get<BoltzmannScene>(again)), to_yaml(scene));
  }
}

TEST(BoltzmannToYaml, ShowsEveryDefault) {
  EXPECT_EQ(to_yaml(gas_with("output: {}")), R"(clca: 1
title: "Test"
seed: 1

boltzmann:
  particles: 10000
  initial: gaussian
  exact_moments: true
  sampling: random
  restitution: 0.5
  friction: 0.3
  roughness: 0
  energy_ratio: 1
  scheme: majorant
  shear_rate: 0
  until: 15
  ensemble: 1

output:
  series: {every: 0.5}
  histograms: [0, 15]
  bins: q20
  checkpoint: {seconds: 60}
)");
}

TEST(BytesOf, GrowWithParticlesAndMembersThatRunAtATime) {
  const auto bytes = [](const std::vector<Override>& overrides, int threads) {
    return gas_run_bytes(gas_with("", overrides), threads);
  };
  const std::string many = "boltzmann.particles=1000000";
  // At work 104 bytes a particle. While it is saved: itself, columns, file and what goes to the
  // disk, 48 each; a run that saves itself at its end keeps the gases for that.
  constexpr double kTables = 1e5;  // a part of them for each member
  EXPECT_NEAR(bytes({many, "output.checkpoint=none"}, 4), 192e6, kTables);
  const double one = bytes({many}, 4);
  EXPECT_NEAR(one, 440e6, kTables);
  EXPECT_NEAR(bytes({many, "boltzmann.ensemble=3"}, 4) - one, 880e6, kTables);
  EXPECT_NEAR(bytes({many, "boltzmann.ensemble=3"}, 2) - one, 632e6, kTables);
  EXPECT_EQ(bytes({many, "boltzmann.sampling=quasi"}, 1), one);
  EXPECT_EQ(bytes({many, "boltzmann.scheme=ogawa-kato"}, 1), one);
  EXPECT_EQ(bytes({many, "boltzmann.scheme=ogawa-kato", "boltzmann.sampling=quasi"}, 1) - one,
            64e6);
}

TEST(BytesOf, GrowWithTheTables) {
  const double least = gas_run_bytes(gas_with("output: {histograms: []}"), 1);
  EXPECT_GE(
      gas_run_bytes(gas_with("output: {histograms: [1, 2], bins: {width: 0.01, end: 15}}"), 1),
      least + 2 * 1501 * 4 * 8.0);
  EXPECT_GE(gas_run_bytes(gas_with("output: {histograms: [], series: {every: 15e-4}}"), 1),
            least + 9900 * 20 * 8.0);
}

}  // namespace clca::scene::boltzmann_test
