#pragma once
// Tables of a run, written as CSV and read back.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace clca::store {

/// Numbers are written in the shortest form that reads back exactly; NaN as an empty cell.
using Cell = std::variant<std::string, std::uint64_t, double>;

class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// Throws std::invalid_argument unless there is one cell per column.
  void add_row(std::vector<Cell> cells);

  std::string to_csv() const;  ///< RFC 4180 with a header line; lines end with a line feed

  /// Bytes that take_csv_rows() would return.
  std::size_t pending_bytes() const { return rows_.size(); }
  /// Returns the rows added since the last call.
  std::string take_csv_rows() { return std::exchange(rows_, {}); }
  std::string csv_header() const;
  const std::vector<std::string>& column_names() const { return columns_; }

 private:
  std::vector<std::string> columns_;
  std::string rows_;
};

/// A table that was read. Cells are text; empty if there is no value.
struct ParsedTable {
  std::filesystem::path file;
  std::vector<std::string> column_names;        ///< of the columns, all different
  std::vector<std::vector<std::string>> cells;  ///< by column, then row

  std::size_t row_count() const { return cells.front().size(); }
  /// The cells of a column; null if there is no such column.
  const std::vector<std::string>* find_column(const std::string& name) const;
  /// A column of numbers; NaN for empty cells. Throws StoreError if there is no such column or a
  /// cell is no number.
  std::vector<double> column_numbers(const std::string& name) const;
};

inline constexpr double kMaxTableBytes = 1 << 30;

/// Reads a table as written by Table. Throws StoreError with file and line for anything else: a
/// truncated file, a row of wrong length, a misplaced quote, more than `max_bytes`.
ParsedTable read_table(const std::filesystem::path& file, double max_bytes = kMaxTableBytes);

}  // namespace clca::store
