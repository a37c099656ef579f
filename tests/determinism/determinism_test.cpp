// The same scene and seed give the same bits: for any number of threads, with pictures or without,
// and, since the expected hashes are in the tree, for every machine, compiler and build type.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "clca/automaton/automaton.hpp"
#include "clca/run/setup.hpp"
#include "support/runs.hpp"

namespace clca {
namespace {

std::map<std::string, std::string> expected_hashes() {
  std::ifstream stream(CLCA_SOURCE_DIR "/tests/data/state_hashes.csv");
  std::map<std::string, std::string> hashes;
  std::string line;
  std::getline(stream, line);  // header
  while (std::getline(stream, line)) {
    const std::size_t comma = line.find(',');
    hashes[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return hashes;
}

std::string hash_of(const scene::Scene& scene, int threads) {
  const testing::ScratchFolder folder;
  return fmt::format("{:016x}",
                     run::run(scene, {.folder = folder.path(), .threads = threads}).state_hash);
}

class Determinism : public ::testing::TestWithParam<const char*> {};

TEST_P(Determinism, EverySceneEndsInTheSameStateForEveryThreadCount) {
  const std::string expected = expected_hashes().at(GetParam());
  for (const int threads : {1, 2, 3, 7}) {
    EXPECT_EQ(hash_of(testing::bare_scene(GetParam(), {}), threads), expected)
        << threads << " threads";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Determinism,
                         ::testing::Values("wall-removal", "silo-collapse", "heap",
                                           "silo-discharge"));

TEST(Determinism, PicturesAndSeriesDoNotChangeTheState) {
  scene::Scene scene = testing::bare_scene("wall-removal", {});
  const std::string bare = hash_of(scene, 1);
  scene.output.series = scene::Series{};
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
    automaton::Automaton sequential(run::initial_state(scene));
    automaton::Automaton parallel(run::initial_state(scene), {.threads = 4, .parallel_from = 1});
    const scene::Stage& packing = scene.stages.front();
    for (automaton::Automaton* automaton : {&sequential, &parallel}) {
      automaton->fill(packing.fill->region, packing.fill->counts);
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

}  // namespace
}  // namespace clca
