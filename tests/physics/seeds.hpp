#pragma once
// One scene for many seeds.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/runs.hpp"

namespace clca::testing {

/// Is given what a run came to and its folder, which is gone afterwards.
using Look = std::function<void(const store::RunSummary&, const std::filesystem::path& folder)>;

/// Runs scenes/NAME.yaml for the seeds 1 to `seeds` and looks at each.
inline void for_seeds(int seeds, const std::string& name,
                      const std::vector<scene::Override>& overrides, const Look& look) {
  for (int seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(fmt::format("{}, seed {}", name, seed));
    auto all = overrides;
    all.push_back(fmt::format("seed={}", seed));
    const ScratchFolder folder;
    look(run::run(bare_scene(name, all), {.folder = folder.path()}), folder.path());
  }
}

/// By discrete elements: the mean of a quantity in a case of bench/peers/references.
inline double discrete_elements(const std::string& name, const std::string& quantity) {
  const std::string begin = name + ',' + quantity + ',';
  std::ifstream file(CLCA_SOURCE_DIR "/bench/results/references.csv");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(begin, 0) == 0) {
      return std::stod(line.substr(begin.size()));
    }
  }
  throw std::invalid_argument("no reference " + begin);
}

/// Of a CSV file that has a line at least.
inline double first_of(const std::filesystem::path& file, const std::string& column) {
  return csv_column(file, column).at(0);
}

inline void expect_within(const std::string& what, double value, double low, double high) {
  EXPECT_GE(value, low) << what;
  EXPECT_LE(value, high) << what;
  ::testing::Test::RecordProperty(what, fmt::format("{:.4g}", value));
}

}  // namespace clca::testing
