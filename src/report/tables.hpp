#pragma once
// The tables of a run folder. What cannot be read is left out and said.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"

namespace clca::report {

/// What is left out of a report and why, each said once.
class Warnings {
 public:
  explicit Warnings(std::function<void(const std::string&)> listener)
      : listener_(std::move(listener)) {}

  void add(const std::string& text);
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::function<void(const std::string&)> listener_;
  std::vector<std::string> texts_;
};

/// A table whose columns may be missing or unsound.
class RunTable {
 public:
  RunTable(std::string label, store::ReadTable table, Warnings& warnings)
      : label_(std::move(label)), table_(std::move(table)), warnings_(&warnings) {}

  /// Stage or time in the name of the file, empty where it has none.
  const std::string& label() const { return label_; }
  const store::ReadTable& cells() const { return table_; }
  /// A column of numbers, NaN where a cell is empty. None where there is no such column; with a
  /// warning where a cell of it is no number.
  std::optional<std::vector<double>> numbers(const std::string& column) const;

 private:
  std::string label_;
  store::ReadTable table_;
  Warnings* warnings_;
};

class Tables {
 public:
  /// `summary` and `warnings` outlive it.
  Tables(const std::filesystem::path& run, const store::RunSummary& summary, Warnings& warnings);

  /// NAME.csv; none where it is missing or cannot be read.
  std::optional<RunTable> find(const std::string& name) const;
  /// NAME-LABEL.csv: in the order of the stages, times as they ascend. Of too many a part, evenly
  /// chosen.
  std::vector<RunTable> find_all(const std::string& name) const;

  /// Names of all files that end in .csv, by the alphabet.
  const std::vector<std::string>& files() const { return files_; }
  const std::filesystem::path& run() const { return run_; }
  const store::RunSummary& summary() const { return *summary_; }

 private:
  std::optional<RunTable> read(const std::string& file, const std::string& label) const;

  std::filesystem::path run_;
  const store::RunSummary* summary_;
  Warnings* warnings_;
  std::vector<std::string> files_;
};

/// The names of regular files in a folder, by the alphabet; none where it cannot be read.
std::vector<std::string> file_names(const std::filesystem::path& folder);

/// `count` of the numbers 0 to `total` - 1 or all, evenly, with the first and the last.
std::vector<std::size_t> evenly(std::size_t total, std::size_t count);

}  // namespace clca::report
