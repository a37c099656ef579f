#include "clca/store/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

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

std::string Table::header() const {
  std::string line;
  for (const std::string& column : columns_) {
    line += line.empty() ? "" : ",";
    line += quoted(column);
  }
  return line + '\n';
}

std::string Table::to_csv() const {
  return header() + rows_;
}

}  // namespace clca::store
