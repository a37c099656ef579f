#include <fmt/format.h>

#include <algorithm>

#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

constexpr std::size_t kMostWalls = 100;

/// Numbers in the form of the table itself, which is the shortest.
std::string cell_html(const std::string& cell) {
  return fmt::format("<td>{}</td>", cell.empty() ? "–" : escaped(cell));
}

std::string table_html(const RunTable& table) {
  const store::ReadTable& cells = table.cells();
  std::string html = fmt::format(
      R"(<h3>At the end of stage {}</h3><div class="wide" tabindex="0" role="region" aria-label="Walls"><table><thead><tr>)",
      escaped(table.label()));
  for (const std::string& name : cells.names) {
    html += fmt::format(R"(<th scope="col">{}</th>)", escaped(name));
  }
  html += "</tr></thead><tbody>";
  for (std::size_t row = 0; row < std::min(cells.rows(), kMostWalls); ++row) {
    html += fmt::format(R"(<tr><th scope="row">{}</th>)", escaped(cells.cells.front()[row]));
    for (std::size_t column = 1; column < cells.names.size(); ++column) {
      html += cell_html(cells.cells[column][row]);
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string walls_html(const Tables& tables) {
  constexpr std::size_t kMostColumns = 30;
  std::string html;
  for (const RunTable& table : tables.find_all("walls")) {
    if (table.cells().rows() > 0 && table.cells().names.size() <= kMostColumns) {
      html += table_html(table);
    }
  }
  return html;
}

}  // namespace clca::report
