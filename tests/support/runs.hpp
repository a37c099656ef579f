#pragma once
// Runs of the project's own scenes inside a test.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/statistics/sample.hpp"

namespace clca::testing {

/// A folder that is empty at first and gone at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// All of a file. Throws store::StoreError.
std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file);

/// scenes/NAME.yaml without pictures and series.
scene::Scene bare_scene(const std::string& name, const std::vector<scene::Override>& overrides);

/// A measure of a stage, by name; NaN where it has no value. Throws std::out_of_range if there is
/// no such stage or measure.
double measure_of(const store::RunSummary& summary, const std::string& stage,
                  const std::string& measure);
std::uint64_t steps_of(const store::RunSummary& summary, const std::string& stage);

/// Fails the test if a value is not finite.
statistics::SampleStatistics sample(const std::vector<double>& values);

/// A column of a CSV file with a header line, without cells that are empty.
std::vector<double> csv_column(const std::filesystem::path& file, const std::string& column);

}  // namespace clca::testing
