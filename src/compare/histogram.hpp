#pragma once
// Tables of shares by bin.

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"

namespace clca::compare {

/// The summary of the run in a folder if it is of one of these kinds. Throws CompareError.
store::RunSummary read_run(const std::filesystem::path& run, const std::vector<std::string>& kinds);

/// A whole text as a number; nothing for any other text, and for NaN and infinities.
std::optional<double> number(const std::string& text);

/// A table of a run. All errors are CompareErrors that begin with the file.
class Histogram {
 public:
  explicit Histogram(std::filesystem::path file);

  bool has(const std::string& column) const;
  /// Keeps the rows whose `column` is `text`.
  void keep(const std::string& column, const std::string& text);
  std::vector<std::string> texts(const std::string& column) const { return cells(column); }
  std::vector<double> numbers(const std::string& column) const;
  /// Numbers of a column that are the shares of equally probable bins: sum 1, or all 0.
  std::vector<double> shares(const std::string& column) const;

  [[noreturn]] void fail(const std::string& why) const;

 private:
  const std::vector<std::string>& cells(const std::string& column) const;

  std::filesystem::path file_;
  store::ReadTable table_;
};

}  // namespace clca::compare
