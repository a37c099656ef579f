// The same scene and seed give the same bits: for any number of threads, with pictures or without,
// and, since the expected hashes are in the tree, for every machine, compiler and build type.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "clca/automaton/automaton.hpp"
#include "clca/model/initial_state.hpp"
#include "support/runs.hpp"
#include "support/stages.hpp"

namespace clca::determinism_test {
namespace {

/// A line of tests/data/state_hashes.csv: SCENE or, with other settings, SCENE/NAME.
struct Expected {
  std::string hash;
  std::vector<scene::Override> overrides;  // what makes a long scene short enough to run often
};

std::map<std::string, Expected> expected_hashes() {
  std::ifstream stream(CLCA_SOURCE_DIR "/tests/data/state_hashes.csv");
  std::map<std::string, Expected> hashes;
  std::string line;
  std::getline(stream, line);  // header
  while (std::getline(stream, line)) {
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    Expected& expected = hashes[line.substr(0, first)];
    expected.hash = line.substr(first + 1, second - first - 1);
    std::istringstream overrides(line.substr(second + 1));
    for (std::string one; std::getline(overrides, one, ';');) {
      expected.overrides.push_back(one);
    }
  }
  return hashes;
}

/// Two threads divide every step, more of them only large ones: on two cores they would wait for
/// each other in each phase.
template <class Scene>
std::string hash_of(const Scene& scene, int threads) {
  const testing::ScratchFolder folder;
  run::RunOptions options = {.folder = folder.path(), .threads = threads};
  if (threads == 2) {
    options.parallel_from = 1;
  }
  return fmt::format("{:016x}", run::run(scene, options).state_hash);
}

std::string reference_hash_of(const scene::Scene& scene) {
  const testing::ScratchFolder folder;
  return fmt::format(
      "{:016x}", run::run(scene, {.folder = folder.path(), .use_reference_step = true}).state_hash);
}

/// A scene of either kind; that of the automaton without pictures and series, which change nothing.
scene::AnyScene any_scene(const std::string& name, const std::vector<scene::Override>& overrides) {
  const std::string file = name.substr(0, name.find('/')) + ".yaml";
  scene::AnyScene scene =
      scene::parse_any_file(std::string(CLCA_SOURCE_DIR "/scenes/") + file, overrides);
  if (auto* automaton = std::get_if<scene::Scene>(&scene)) {
    automaton->output = {};
  }
  return scene;
}

class Determinism : public ::testing::TestWithParam<const char*> {};

TEST_P(Determinism, EverySceneEndsInTheSameStateByBothEnginesForEveryThreadCount) {
  const Expected expected = expected_hashes().at(GetParam());
  const scene::AnyScene any = any_scene(GetParam(), expected.overrides);
  for (const int threads : {7, 3, 2, 1}) {  // LLVM's OpenMP loses memory of a team that grows
    const std::string hash =
        std::visit([&](const auto& scene) { return hash_of(scene, threads); }, any);
    EXPECT_EQ(hash, expected.hash) << threads << " threads";
  }
  if (const auto* scene = std::get_if<scene::Scene>(&any)) {
    EXPECT_EQ(reference_hash_of(*scene), expected.hash) << "reference";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Determinism,
    ::testing::Values("wall-removal", "wall-removal/ties-by-direction", "wall-removal/scatter",
                      "wall-removal/gravity-first", "silo-collapse", "heap", "silo-discharge",
                      "two-orifices", "outlet", "outlet/voids", "outlet/baxter", "mixing", "hopper",
                      "hopper-sizes", "pattern", "clogging", "collapse-aspect", "brazil-nut",
                      "segregation", "convection", "avalanche-taps", "plate-penetration", "piston",
                      "boltzmann-case1", "boltzmann-case2", "boltzmann-epsilon-sweep",
                      "boltzmann-late", "boltzmann-shear"));

/// A run of wall-removal by the contact model, under the name that the list of hashes has for it.
struct ContactRun {
  std::string name;
  std::vector<scene::Override> overrides;
};

const std::vector<ContactRun>& contact_runs() {
  // Packing and flow are cut short; the flow is long enough for the heap to collapse.
  static const std::vector<ContactRun> runs = [] {
    const std::vector<scene::Override> common = {
        "model=contact", "stages.packing.until={steps: 1500}", "stages.flow.until={steps: 400}"};
    std::vector<ContactRun> all;
    for (const char* rolling : {"resistance", "none", "free"}) {
      all.push_back({fmt::format("contact-{}", rolling), common});
      all.back().overrides.push_back(fmt::format("contact.rolling={}", rolling));
    }
    all.push_back({"contact-vessel", common});
    all.back().overrides.emplace_back("stages.flow.vessel={rotate: {rate: -0.02}}");
    // A gate that is drawn up, slowly enough for the column to flow out below it.
    all.push_back({"contact-gate",
                   {"model=contact", "stages.packing.until={steps: 1500}",
                    "walls.right.motion={direction: up, period: 8, distance: 40}",
                    "stages.flow={name: flow, move: [right], until: {steps: 400}}"}});
    return all;
  }();
  return runs;
}

class ContactDeterminism : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ContactDeterminism, BothEnginesAnyThreadsAndAResumedRunEndInTheSameState) {
  const ContactRun& one = contact_runs()[GetParam()];
  const std::string expected = expected_hashes().at(one.name).hash;
  const scene::Scene scene = testing::bare_scene("wall-removal", one.overrides);
  for (const int threads : {1, 2}) {
    EXPECT_EQ(hash_of(scene, threads), expected) << threads << " threads";
  }
  EXPECT_EQ(reference_hash_of(scene), expected) << "reference";

  // Stopped in the middle of both stages.
  const testing::ScratchFolder folder;
  const std::filesystem::path broken = folder.path() / "b";
  std::atomic<int> stop = 0;
  std::uint64_t until = 700;
  const run::RunEvents events = {
      .progress = [&](const run::Progress& at) { stop = at.step >= until ? 2 : 0; },
      .progress_interval = {}};
  EXPECT_EQ(run::run(scene, {.folder = broken, .stop_signal = &stop}, events).status,
            "interrupted");
  until = 1700;
  stop = 0;
  run::resume(run::load_run(broken, 1e9), {.stop_signal = &stop}, events);
  const auto resumed = run::resume(run::load_run(broken, 1e9), {});
  EXPECT_EQ(fmt::format("{:016x}", resumed.state_hash), expected) << "resumed";
}

INSTANTIATE_TEST_SUITE_P(Contact, ContactDeterminism,
                         ::testing::Range<std::size_t>(0, contact_runs().size()));

// What the scenes do not have: a gas of several groups on several threads, and the other schemes.
TEST(Determinism, EveryKindOfGasIsTheSameForEveryThreadCount) {
  const std::vector<std::vector<scene::Override>> kinds = {
      {"boltzmann.particles=50000", "boltzmann.ensemble=1"},
      {"boltzmann.particles=20000", "boltzmann.ensemble=3"},
      {"boltzmann.particles=20000", "boltzmann.ensemble=1", "boltzmann.sampling=quasi"},
      {"boltzmann.particles=50000", "boltzmann.ensemble=1", "boltzmann.shear_rate=0.5"},
      {"boltzmann.particles=5000", "boltzmann.ensemble=1", "boltzmann.scheme=ogawa-kato"},
      {"boltzmann.particles=5000", "boltzmann.ensemble=3", "boltzmann.scheme=ogawa-kato"},
      {"boltzmann.particles=5000", "boltzmann.ensemble=1", "boltzmann.scheme=ogawa-kato",
       "boltzmann.sampling=quasi"},
  };
  for (std::vector<scene::Override> overrides : kinds) {
    overrides.insert(overrides.begin(), {"boltzmann.until=2", "output.histograms=[0, 2]"});
    const auto scene = std::get<scene::BoltzmannScene>(any_scene("boltzmann-case1", overrides));
    const std::string alone = hash_of(scene, 1);
    for (const int threads : {7, 3, 2}) {  // as above
      EXPECT_EQ(hash_of(scene, threads), alone)
          << fmt::format("{} on {} threads", overrides.back().text, threads);
    }
  }
}

TEST(Determinism, PicturesAndSeriesDoNotChangeTheState) {
  scene::Scene scene = testing::bare_scene("wall-removal", {});
  const std::string bare = hash_of(scene, 1);
  scene.output.series = scene::SeriesOutput{};
  scene.output.frames.emplace();
  scene.output.frames->every = 100;
  scene.output.frames->width = 160;
  scene.output.frames->height = 90;
  EXPECT_EQ(hash_of(scene, 1), bare);
}

// Every step on several threads, however few particles are awake; a million sites.
TEST(Determinism, ParallelStepsEqualSequentialOnesForBothKindsOfTies) {
  for (const char* ties : {"particle", "direction"}) {
    const scene::Scene scene =
        testing::bare_scene("silo-collapse", {fmt::format("rules.ties={}", ties)});
    automaton::Automaton sequential(model::initial_state(scene), scene.automaton_rules);
    automaton::Automaton parallel(model::initial_state(scene), scene.automaton_rules,
                                  {.threads = 4, .min_parallel_particles = 1});
    const scene::Stage& packing = scene.stages.front();
    for (automaton::Automaton* automaton : {&sequential, &parallel}) {
      automaton->fill(packing.fill->region, packing.fill->species_counts);
      for (int step = 0; step < 400; ++step) {
        automaton->step();
      }
      automaton->remove_wall(0);
      automaton->remove_wall(1);
      for (int step = 0; step < 200; ++step) {
        automaton->step();
      }
    }
    EXPECT_EQ(parallel.state(), sequential.state()) << ties;
  }
}

/// The first two stages of a scene, the second for 300 steps at most.
grains::State state_after(const scene::Scene& scene, const automaton::Options& options) {
  automaton::Automaton automaton(testing::stage_begun(scene, 0, model::initial_state(scene)),
                                 scene.automaton_rules, options);
  while (!automaton.step().settled) {
  }
  automaton = automaton::Automaton(testing::stage_begun(scene, 1, automaton.state()),
                                   scene.automaton_rules, options);
  for (int step = 0; step < 300 && !automaton.step().settled; ++step) {
  }
  return automaton.state();
}

// A floor that pushes and a plate and a piston that enter, with rods among the hexagons.
TEST(Determinism, ParallelStepsEqualSequentialOnesWhileWallsMove) {
  const std::string rods =
      "species.small={shape: {rod: {radius: 0, length: 4}}, orientations: any}";
  for (const char* name : {"segregation", "plate-penetration", "piston"}) {
    for (const std::string& species : {std::string("species.large.shape.hexagon=2"), rods}) {
      const scene::Scene scene = testing::bare_scene(name, {species});
      const grains::State sequential = state_after(scene, {});
      EXPECT_NE(sequential.walls.front().travel.clock, 0U);
      EXPECT_EQ(state_after(scene, {.threads = 4, .min_parallel_particles = 1}), sequential)
          << name << ", " << species;
    }
  }
}

}  // namespace
}  // namespace clca::determinism_test
