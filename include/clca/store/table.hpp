#pragma once
// Tables of a run, written as CSV and read back.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
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

  /// Bytes of rows that take() would give.
  std::size_t waiting() const { return rows_.size(); }
  /// The rows that came since the last call, and forgets them.
  std::string take() { return std::exchange(rows_, {}); }
  std::string header() const;

 private:
  std::vector<std::string> columns_;
  std::string rows_;
};

/// A table read back. Cells are text as it was written, nothing where there is no value.
struct ReadTable {
  std::filesystem::path file;
  std::vector<std::string> names;               ///< of the columns, all different
  std::vector<std::vector<std::string>> cells;  ///< by column, then row

  std::size_t rows() const { return cells.front().size(); }
  /// The cells of a column; none where there is no such column.
  const std::vector<std::string>* find(const std::string& name) const;
  /// A column of numbers; NaN where a cell is empty. Throws StoreError where there is no such
  /// column or a cell is no number.
  std::vector<double> numbers(const std::string& name) const;
};

inline constexpr double kMostTableBytes = 1 << 30;

/// Reads a table as Table writes it. Throws StoreError, with file and line, for everything else: a
/// file that is cut off, a row that is too short or too long, a quote out of place, more than
/// `most_bytes`.
ReadTable read_table(const std::filesystem::path& file, double most_bytes = kMostTableBytes);

}  // namespace clca::store
