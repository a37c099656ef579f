#include "clca/store/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string_view>

#include "clca/store/file.hpp"
#include "clca/text/read.hpp"

namespace clca::store {

namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    return text;
  }
  std::string result = "\"";
  for (const char letter : text) {
    result += letter == '"' ? "\"\"" : std::string(1, letter);
  }
  return result + '"';
}

std::string to_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) {
    return quoted(*text);
  }
  if (const auto* number = std::get_if<double>(&cell)) {
    return std::isnan(*number) ? std::string() : fmt::format("{}", *number);
  }
  return fmt::format("{}", std::get<std::uint64_t>(cell));
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line,
                         std::string_view reason) {
  throw StoreError(fmt::format("cannot read {}: line {}: {}", file.string(), line, reason));
}

/// Reads the cells of a text one by one: strict, since the file may be truncated or foreign.
class CellReader {
 public:
  CellReader(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {}

  bool at_end() const { return text_.empty(); }
  std::size_t line() const { return line_; }

  /// One row, to the end of its line.
  std::vector<std::string> row() {
    std::vector<std::string> cells;
    do {
      cells.push_back(text_.starts_with('"') ? quoted() : plain());
    } while (takes(','));
    if (!takes('\n')) {
      refuse(file_, line_,
             at_end()                           ? "the file is cut off"
             : text_.find_first_of("\"\r") == 0 ? "a quote or carriage return out of place"
                                                : "a character after a closing quote");
    }
    ++line_;
    return cells;
  }

 private:
  bool takes(char letter) {
    const bool found = text_.starts_with(letter);
    text_.remove_prefix(found ? 1 : 0);
    return found;
  }

  std::string_view taken(std::size_t count) {
    const std::string_view front = text_.substr(0, count);
    text_.remove_prefix(front.size());
    return front;
  }

  std::string plain() { return std::string(taken(text_.find_first_of(",\"\r\n"))); }

  std::string quoted() {
    std::string cell;
    takes('"');
    while (true) {
      const std::size_t end = text_.find('"');
      if (end == std::string_view::npos) {
        refuse(file_, line_, "a quote is not closed");
      }
      cell += taken(end);
      takes('"');
      if (!takes('"')) {
        line_ += static_cast<std::size_t>(std::ranges::count(cell, '\n'));
        return cell;
      }
      cell += '"';
    }
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  std::size_t line_ = 1;
};

}  // namespace

void Table::add_row(std::vector<Cell> cells) {
  if (cells.size() != columns_.size()) {
    throw std::invalid_argument("a row has one cell per column");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    rows_ += to_text(cells[i]);
    rows_ += i + 1 < cells.size() ? ',' : '\n';
  }
}

std::string Table::csv_header() const {
  std::string line;
  for (const std::string& column : columns_) {
    line += line.empty() ? "" : ",";
    line += quoted(column);
  }
  return line + '\n';
}

std::string Table::to_csv() const {
  return csv_header() + rows_;
}

const std::vector<std::string>* ParsedTable::find_column(const std::string& name) const {
  const auto found = std::ranges::find(column_names, name);
  return found == column_names.end()
             ? nullptr
             : &cells[static_cast<std::size_t>(found - column_names.begin())];
}

std::vector<double> ParsedTable::column_numbers(const std::string& name) const {
  const std::vector<std::string>* column = find_column(name);
  if (column == nullptr) {
    throw StoreError(fmt::format("cannot read {}: no column '{}'", file.string(), name));
  }
  std::vector<double> values(column->size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < values.size(); ++row) {
    const std::string& cell = (*column)[row];
    const auto number = text::number<double>(cell);
    values[row] = number.value_or(values[row]);
    if (!cell.empty() && !number) {
      refuse(file, row + 2, fmt::format("'{}' in column '{}' is no number", cell, name));
    }
  }
  return values;
}

ParsedTable read_table(const std::filesystem::path& file, double max_bytes) {
  const auto bytes = read_whole_file(file, max_bytes);
  CellReader reader(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  ParsedTable table = {.file = file, .column_names = reader.row(), .cells = {}};
  std::set<std::string_view> known;
  for (const std::string& name : table.column_names) {
    if (name.empty() || !known.insert(name).second) {
      refuse(file, 1, fmt::format("the name '{}' of a column is empty or there twice", name));
    }
  }
  table.cells.resize(table.column_names.size());
  while (!reader.at_end()) {
    const std::size_t line = reader.line();
    std::vector<std::string> row = reader.row();
    if (row.size() != table.column_names.size()) {
      refuse(file, line,
             fmt::format("{} cells in {} columns", row.size(), table.column_names.size()));
    }
    for (std::size_t column = 0; column < row.size(); ++column) {
      table.cells[column].push_back(std::move(row[column]));
    }
  }
  return table;
}

}  // namespace clca::store
