#pragma once
// The tables of a run folder, read on first use.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "plot/template.hpp"

namespace clca::plot {

struct TableFile {
  std::string name;   ///< profile-flow.csv
  std::string label;  ///< what `*` stands for: flow
};

class RunTables {
 public:
  /// Of a run or a sweep. Throws StoreError where a run has no whole run.json.
  explicit RunTables(const std::filesystem::path& run);

  const std::filesystem::path& run() const { return run_; }
  const store::RunSummary& summary() const { return summary_; }
  /// Of the scene, or else the name of the run or of the folder of the sweep.
  const std::string& title() const {
    return summary_.title.empty() ? summary_.scene : summary_.title;
  }

  /// The files for a table of a template, in order of stages or times.
  std::vector<TableFile> files(const std::string& table) const;

  /// Those of them that meet the requirement. Throws StoreError.
  std::vector<TableFile> files(const TableRequirement& need);

  /// Throws StoreError.
  const store::ReadTable& read(const std::string& file);

 private:
  bool satisfies(const std::string& file, const TableRequirement& need);

  std::filesystem::path run_;
  store::RunSummary summary_;
  std::vector<std::string> names_;
  std::map<std::string, store::ReadTable> tables_;
};

/// Whether the column exists and has a non-zero value in a selected row.
bool has_values(const store::ReadTable& table, const std::string& column,
                const TableRequirement& need);

/// The columns with values that a column of a requirement stands for: itself, or those with its
/// prefix where it ends in `*`. Those whose other part is no label are left out.
std::vector<std::string> matching_columns(const store::ReadTable& table, const std::string& column,
                                          const TableRequirement& need);

/// Names of stages and numbers are made of these.
bool is_label(const std::string& text);

bool is_number(const std::string& text);

/// The values in order: numbers ascend, where all are; words as they appear.
std::vector<std::string> in_order(const std::vector<std::string>& values);

}  // namespace clca::plot
