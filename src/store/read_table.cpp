// CSV back to a table.

#include <fmt/format.h>

#include <utility>

#include "clca/store/file.hpp"
#include "clca/store/table.hpp"

namespace clca::store {

namespace {

/// Splits RFC 4180 into rows of cells.
class Reader {
 public:
  void take(char letter);
  /// Ends the last line; false when a quote is open.
  bool finish();
  std::vector<std::vector<std::string>>& lines() { return lines_; }

 private:
  void end_cell() { line_.push_back(std::exchange(cell_, {})); }
  void end_line() {
    end_cell();
    lines_.push_back(std::exchange(line_, {}));
  }

  std::vector<std::vector<std::string>> lines_;
  std::vector<std::string> line_;
  std::string cell_;
  bool quoted_ = false;
  bool closed_ = false;  // a quote ended just now: a second one stands for itself
};

void Reader::take(char letter) {
  const bool doubled = std::exchange(closed_, false) && letter == '"';
  if (letter == '"') {
    if (doubled) {
      cell_ += letter;
    }
    closed_ = quoted_;
    quoted_ = !quoted_;
  } else if (letter == ',' && !quoted_) {
    end_cell();
  } else if (letter == '\n' && !quoted_) {
    end_line();
  } else if (letter != '\r' || quoted_) {
    cell_ += letter;
  }
}

bool Reader::finish() {
  if (!line_.empty() || !cell_.empty()) {
    end_line();
  }
  return !quoted_;
}

}  // namespace

TableData read_table(const std::filesystem::path& file) {
  Reader reader;
  for (const std::uint8_t byte : read_whole(file)) {
    reader.take(static_cast<char>(byte));
  }
  if (!reader.finish() || reader.lines().empty()) {
    throw StoreError(fmt::format("cannot read {}: it is cut off or no table", file.string()));
  }
  TableData table = {.columns = std::move(reader.lines().front()), .rows = {}};
  for (std::size_t line = 1; line < reader.lines().size(); ++line) {
    if (reader.lines()[line].size() != table.columns.size()) {
      throw StoreError(fmt::format("cannot read {}: line {} has {} cells, not {}", file.string(),
                                   line + 1, reader.lines()[line].size(), table.columns.size()));
    }
    table.rows.push_back(std::move(reader.lines()[line]));
  }
  return table;
}

}  // namespace clca::store
