#include "support/runs.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "clca/store/file.hpp"

namespace clca::testing {

namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    result.push_back(cell);
  }
  return result;
}

const store::StageSummary& stage_of(const store::RunSummary& summary, const std::string& name) {
  const auto found = std::find_if(summary.stages.begin(), summary.stages.end(),
                                  [&](const auto& stage) { return stage.name == name; });
  if (found == summary.stages.end()) {
    throw std::out_of_range("no stage " + name);
  }
  return *found;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "clca-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("cannot make a scratch folder");
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
  return store::read_whole_file(file, 1e9);
}

scene::Scene bare_scene(const std::string& name, const std::vector<scene::Override>& overrides) {
  const std::filesystem::path file =
      std::filesystem::path(CLCA_SOURCE_DIR) / "scenes" / (name + ".yaml");
  scene::Scene scene = scene::parse_file(file, overrides);
  scene.output = {};
  return scene;
}

double measure_of(const store::RunSummary& summary, const std::string& stage,
                  const std::string& measure) {
  for (const auto& [name, value] : stage_of(summary, stage).measures) {
    if (name == measure) {
      const double* number = std::get_if<double>(&value);
      return number != nullptr ? *number : std::numeric_limits<double>::quiet_NaN();
    }
  }
  throw std::out_of_range("no measure " + measure);
}

std::uint64_t steps_of(const store::RunSummary& summary, const std::string& stage) {
  return stage_of(summary, stage).steps;
}

statistics::SampleStatistics sample(const std::vector<double>& values) {
  const statistics::SampleStatistics result = statistics::sample_statistics(values);
  EXPECT_EQ(result.count, values.size()) << "not all values are numbers";
  return result;
}

std::vector<double> csv_column(const std::filesystem::path& file, const std::string& column) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = cells(line);
  const auto found = std::find(header.begin(), header.end(), column);
  if (found == header.end()) {
    throw std::out_of_range("no column " + column + " in " + file.string());
  }
  const auto place = static_cast<std::size_t>(found - header.begin());
  std::vector<double> values;
  while (std::getline(stream, line)) {
    const std::vector<std::string> row = cells(line);
    if (place < row.size() && !row[place].empty()) {  // an empty last cell is none of them
      values.push_back(std::stod(row[place]));
    }
  }
  return values;
}

}  // namespace clca::testing
