#pragma once
// Tables of a run, written as CSV.

#include <cstdint>
#include <filesystem>
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

/// A table read back: the header, and each row with one text per column.
struct TableData {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Reads CSV as Table writes it. Throws StoreError (file.hpp) when it cannot be read, a quote is
/// left open or a row has not one cell per column.
TableData read_table(const std::filesystem::path& file);

}  // namespace clca::store
