// The program with too little memory, at limits from what it takes to start up to what a run takes:
// it is done, or fails with one line and can be gone on with, to the same end as a run with enough.
// CLCA_MEMORY_LIMITS says at how many limits; a few where it is not set.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

#include "support/program.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::memory_test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMebibyte = std::size_t{1} << 20U;

constexpr const char* kPictures = R"(clca: 1
box: {width: 60, height: 90}
species: {small: {shape: {hexagon: 1}}, large: {shape: {hexagon: 2}}}
walls: {floor: {box: [0, 0, 60, 2], motion: {direction: up, shake: {amplitude: 3, wait: 4}}}}
stages:
  - {name: packing, fill: {region: [0, 2, 60, 90], counts: {small: 200, large: 30}}, until: {steps: 40}}
  - {name: shaking, move: [floor], until: {cycles: 4}}
output: {frames: {every: 10, width: 800, height: 1200}, series: {every: 1}, checkpoint: {every: 9}}
)";

constexpr const char* kManyParticles = R"(clca: 1
box: {width: 900, height: 900}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: fall, fill: {region: [0, 0, 900, 900], counts: {grain: 60000}}, until: {steps: 16}}]
output: {series: {every: 1}, trajectory: {every: 5}, checkpoint: {every: 7}}
)";

constexpr const char* kGas = R"(clca: 1
boltzmann: {particles: 60000, ensemble: 2, restitution: 0.9, friction: 0.3, until: 0.5}
output: {checkpoint: {seconds: 0.05}}
)";

int limits() {
  constexpr int kFew = 8;
  const char* text = std::getenv("CLCA_MEMORY_LIMITS");
  return text != nullptr ? std::atoi(text) : kFew;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The least number of MiB with which `ends_well`, nearly.
template <class EndsWell>
std::size_t min_mebibytes(std::size_t low, EndsWell ends_well) {
  std::size_t high = std::max<std::size_t>(low, 1);
  while (!ends_well(high)) {
    low = high;
    high *= 2;
  }
  while (low + 4 < high) {
    const std::size_t middle = (low + high) / 2;
    (ends_well(middle) ? high : low) = middle;
  }
  return high;
}

class TooLittleMemory : public ::testing::TestWithParam<const char*> {
 protected:
  TooLittleMemory() { std::ofstream(scene_) << GetParam(); }

  testing::ProgramResult run(const std::string& out, int threads, std::size_t mebibytes) const {
    return testing::run_program({"run", scene_, "-o", out, "--quiet", "--threads",
                                 std::to_string(threads), "--memory-limit", "100GiB"},
                                {.memory_limit = mebibytes * kMebibyte});
  }
  void compare_at(std::size_t mebibytes, int threads) const;

  testing::ScratchFolder folder_;
  std::string scene_ = (folder_.path() / "scene.yaml").string();
  std::string enough_ = (folder_.path() / "enough").string();
};

void TooLittleMemory::compare_at(std::size_t mebibytes, int threads) const {
  const std::string out = (folder_.path() / "out").string();
  fs::remove_all(out);
  const auto result = run(out, threads, mebibytes);
  if (result.code != 0) {
    ASSERT_EQ(result.code, 1) << result.err;
    EXPECT_THAT(result.err,
                ::testing::MatchesRegex("(warning: only [^\n]*\n)?clca: error: [^\n]*\n"));
    if (!fs::exists(out + "/run.json")) {
      return;  // nothing had begun
    }
    EXPECT_NE(text_of(out + "/run.json").find("\"failed\""), std::string::npos) << result.err;
    const auto resumed = testing::run_program({"resume", out, "--quiet"});
    ASSERT_EQ(resumed.code, 0) << resumed.err;
  }
  EXPECT_EQ(testing::difference_of_runs(enough_, out), "");
}

TEST_P(TooLittleMemory, EndsWithOneLineAndARunThatCanBeGoneOnWith) {
  ASSERT_EQ(run(enough_, 1, 0).code, 0);
  const std::size_t low = min_mebibytes(1, [](std::size_t mebibytes) {
    return testing::run_program({"--version"}, {.memory_limit = mebibytes * kMebibyte}).code == 0;
  });
#ifdef __clang__
  const std::vector<int> numbers = {1};  // LLVM's OpenMP ends a program that gets no thread
#else
  const std::vector<int> numbers = {1, 2};
#endif
  for (const int threads : numbers) {
    const std::size_t high = min_mebibytes(low, [&](std::size_t mebibytes) {
      const std::string out = (folder_.path() / "out").string();
      fs::remove_all(out);
      return run(out, threads, mebibytes).code == 0;
    });
    for (int i = 0; i < limits(); ++i) {
      const std::size_t mebibytes =
          low + (high - low) * static_cast<std::size_t>(i) / static_cast<std::size_t>(limits());
      SCOPED_TRACE(std::to_string(mebibytes) + " MiB, " + std::to_string(threads) + " threads");
      compare_at(mebibytes, threads);
    }
  }
}

std::string name_of(const ::testing::TestParamInfo<const char*>& scene) {
  const std::vector<std::string> names = {"Pictures", "ManyParticles", "AGas"};
  return names.at(scene.index);
}

INSTANTIATE_TEST_SUITE_P(Of, TooLittleMemory, ::testing::Values(kPictures, kManyParticles, kGas),
                         name_of);

}  // namespace
}  // namespace clca::memory_test
