// A scene that a run would refuse at once is found out without one.

#include <gtest/gtest.h>

#include "clca/run/run.hpp"
#include "clca/run/setup.hpp"
#include "support/runs.hpp"

namespace clca::run::beginning_test {
namespace {

scene::Scene rain(const std::string& counts, const std::string& frames) {
  return scene::parse(
      "clca: 1\nbox: {width: 20, height: 20}\n"
      "species: {grain: {shape: {hexagon: 1}}}\n"
      "stages: [{name: rain, fill: {region: [0, 0, 20, 20], counts: {grain: " +
          counts + "}}, until: {steps: 3}}]\noutput: {frames: " + frames + "}\n",
      "rain.yaml");
}

/// What both say, which is the same.
std::string refusal(const scene::Scene& scene) {
  const testing::ScratchFolder folder;
  std::string by_run;
  std::string by_check;
  try {
    run(scene, {.folder = folder.path() / "out"});
  } catch (const std::runtime_error& error) {
    by_run = error.what();
  }
  EXPECT_EQ(std::filesystem::exists(folder.path() / "out"), by_run.empty());
  try {
    try_start(scene);
  } catch (const std::runtime_error& error) {
    by_check = error.what();
  }
  EXPECT_EQ(by_run, by_check);
  return by_check;
}

TEST(ABeginning, IsRefusedAsTheRunIs) {
  EXPECT_EQ(refusal(rain("10", "none")), "");
  EXPECT_NE(refusal(rain("60", "none")).find("does not fit"), std::string::npos)
      << "fewer sites than there are, but too many for a rain";
  EXPECT_NE(refusal(rain("6000", "none")).find("the counts take 42000 sites"), std::string::npos);
  EXPECT_NE(refusal(rain("10", "{every: 1, width: 65536, height: 200}")).find("too large"),
            std::string::npos);
}

}  // namespace
}  // namespace clca::run::beginning_test
