#pragma once
// The tables of a run folder, each read when it is first asked for.

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
  /// Throws StoreError where there is no whole run.json.
  explicit RunTables(const std::filesystem::path& run);

  const std::filesystem::path& run() const { return run_; }
  const store::RunSummary& summary() const { return summary_; }

  /// The files that a table of a template stands for: in the order of the stages or times.
  std::vector<TableFile> files(const std::string& table) const;

  /// Those of them that have what is needed. Throws StoreError.
  std::vector<TableFile> files(const Need& need);

  /// Throws StoreError.
  const store::ReadTable& read(const std::string& file);

 private:
  bool satisfies(const std::string& file, const Need& need);

  std::filesystem::path run_;
  store::RunSummary summary_;
  std::vector<std::string> names_;
  std::map<std::string, store::ReadTable> tables_;
};

/// Whether a column is there and has a value that is not 0 in one of the rows that are chosen.
bool says_something(const store::ReadTable& table, const std::string& column, const Need& need);

/// Names of stages and numbers are made of these.
bool is_label(const std::string& text);

}  // namespace clca::plot
