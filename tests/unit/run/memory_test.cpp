// What the outputs of a run add to the estimate of its memory.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"

namespace clca::run::memory_test {
namespace {

constexpr const char* kScene = R"(clca: 1
box: {width: 100, height: 50}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: fall, fill: {region: [0, 0, 100, 50], counts: {grain: 400}}, until: {steps: 5}}]
measure: []
output: {}
)";

double memory_with(const std::vector<scene::Override>& overrides) {
  return estimated_run_bytes(scene::parse(kScene, "scene.yaml", overrides));
}

TEST(MemoryOf, GrowsWithWhatIsWritten) {
  const double least = memory_with({});
  EXPECT_GT(least, scene::model_size(scene::parse(kScene, "scene.yaml")).memory_bytes);
  EXPECT_GT(memory_with({"output.trajectory={}"}), least + 0x1p24);
  EXPECT_GT(memory_with({"measure=[mixing]"}), least + 400 * 100);
  const std::string picture = "width: 1000, height: 500, supersampling: 3";
  const double lookup = memory_with({"output.frames={" + picture + "}"});
  EXPECT_GT(lookup, least + 500'000.0 * 4 * 3);
  EXPECT_GT(memory_with({"output.frames={drawing: polygons, " + picture + "}"}),
            lookup + 500'000.0 * 9 * 8);
  const double series = memory_with({"output.series={}"});
  EXPECT_GT(
      memory_with({"output.series={}", "lines={row: {from: [0, 5], to: [99, 5], parts: 1000}}"}),
      series + 1000 * 16 * 56);
}

TEST(MemoryOf, CountsThePositionsThatPicturesOfVelocitiesRemember) {
  const std::string frames = "output.frames={width: 100, height: 100}";
  EXPECT_GE(memory_with({frames, "output.frames.overlay=velocity"}),
            memory_with({frames}) + 400 * 60);
}

TEST(MemoryOf, CountsThePathsOfWeightThatPicturesShow) {
  const std::string frames = "output.frames={width: 100, height: 100}";
  EXPECT_GE(memory_with({frames, "output.frames.overlay=weight_q"}),
            memory_with({frames}) + 400 * 1000);
}

TEST(MemoryOf, CountsWindowsOfForces) {
  const std::string contact = "model=contact";
  const double least = memory_with({contact});
  const double window = memory_with({contact, "measure=[force]"}) - least;
  EXPECT_GT(window, 3 * 120 * 400) << "a sum and its number for each of three contacts";
  EXPECT_GT(memory_with({contact, "output.trajectory={contacts: true}"}),
            memory_with({contact, "output.trajectory={}"}) + window);
  const std::string picture = "output.frames={width: 100, height: 100}";
  EXPECT_GT(memory_with({contact, picture, "output.frames.overlay=forces"}),
            memory_with({contact, picture}) + window);
}

}  // namespace
}  // namespace clca::run::memory_test
