#pragma once
// Tables of a run, written as CSV.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace clca::store {

/// Numbers are written in the shortest form that reads back to the same value; NaN as nothing.
using Cell = std::variant<std::string, std::uint64_t, double>;

class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Throws std::invalid_argument unless there is one cell per column.
  void add_row(std::vector<Cell> cells);

  /// RFC 4180 with a header line; lines end with a line feed.
  std::string to_csv() const;

 private:
  std::vector<std::string> columns_;
  std::string rows_;
};

}  // namespace clca::store
