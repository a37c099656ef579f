// The estimate of the memory of a run beside what the program takes: not below, nor far above where
// the run is large.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <ostream>
#include <string>

#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::memory_estimate_test {
namespace {

struct Case {
  const char* name;
  const char* model;
  const char* more;   // the rest of the scene
  int spacings = 13;  // square ones, for each grain

  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }
};

/// A box full of grains. Those of the contact model touch each other.
std::string text_of(const Case& scene, int width, int pixels) {
  const std::string model = scene.model;
  std::string more = scene.more;
  if (const std::size_t at = more.find("PIXELS"); at != std::string::npos) {
    more.replace(at, 6, std::to_string(pixels));
  }
  return fmt::format(
      "clca: 1\nmodel: {0}\nbox: {{width: {1}, height: {1}}}\n"
      "species: {{grain: {{shape: {{hexagon: {2}}}}}}}\n"
      "stages: [{{name: fall, fill: {{region: [0, 0, {1}, {1}], counts: {{grain: {3}}}, method: "
      "{4}}}, until: {{steps: 12}}}}]\n{5}",
      model, width, model == "voids" ? 0 : 1, width * width / scene.spacings,
      model == "contact" ? "deposition" : "random", more);
}

class MemoryEstimate : public ::testing::TestWithParam<Case> {};

TEST_P(MemoryEstimate, IsAboveWhatARunTakesAndNotMuch) {
  const testing::ScratchFolder folder;
  const auto bytes = [&](int width, int pixels) {
    const std::string scene = (folder.path() / "scene.yaml").string();
    std::ofstream(scene) << text_of(GetParam(), width, pixels);
    const auto result =
        testing::run_program({"run", scene, "-o", (folder.path() / "out").string(), "--quiet",
                              "--threads", "2", "--memory-limit", "100GiB"});
    EXPECT_EQ(result.code, 0) << result.err;
    return result.max_bytes;
  };
  const double taken = bytes(1200, 2000) - bytes(40, 100);
  const double estimate =
      run::estimated_run_bytes(scene::parse(text_of(GetParam(), 1200, 2000), "scene.yaml"));
  EXPECT_GE(estimate, taken);
  EXPECT_LE(estimate, 3 * taken);
}

INSTANTIATE_TEST_SUITE_P(
    Of, MemoryEstimate,
    ::testing::Values(
        Case{"Automaton", "automaton", "output: {}\n"}, Case{"Voids", "voids", "output: {}\n"},
        Case{"ContactModel", "contact", "output: {checkpoint: {every: 4}}\nmeasure: []\n"},
        Case{"Mixing", "automaton", "output: {}\nmeasure: [mixing]\n"},
        Case{"LinesAndFields", "automaton",
             "lines: {row: {from: [0, 30], to: [39, 30], parts: 30}}\n"
             "output: {series: {every: 1}, fields: {every: 4, cell: 6}}\n"},
        Case{"FieldsOfSmallCells", "automaton", "output: {fields: {every: 4, cell: 1}}\n"},
        Case{"Trajectory", "automaton", "output: {trajectory: {every: 1}}\n"},
        Case{"TrajectoryOfContacts", "contact",
             "output: {trajectory: {every: 2, contacts: true}}\n"},
        Case{"Forces", "contact",
             "output: {frames: {every: 4, width: 100, overlay: forces}}\n"
             "measure: [force, weight_paths]\n"},
        Case{"WeightPaths", "voids", "output: {}\nmeasure: [weight_paths]\n", 1},
        Case{"WeightPathsOfAThinBed", "automaton", "output: {}\nmeasure: [weight_paths]\n"},
        Case{"PicturesOfWeights", "voids",
             "output: {frames: {every: 4, width: 100, overlay: weight_q}}\n", 1},
        Case{"PicturesOfVelocities", "automaton",
             "output: {frames: {every: 4, width: PIXELS, overlay: velocity}}\n"}),
    [](const ::testing::TestParamInfo<Case>& one) { return one.param.name; });

}  // namespace
}  // namespace clca::memory_estimate_test
