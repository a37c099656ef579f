#include <fmt/format.h>

#include <algorithm>

#include "clca/store/file.hpp"
#include "clca/store/table.hpp"
#include "clca/text/read.hpp"
#include "report/folder.hpp"
#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

namespace fs = std::filesystem;
using text::is_file_name;

constexpr std::size_t kMaxWalls = 100;

/// Numbers in the form of the table itself, which is the shortest.
std::string cell_html(const std::string& heading, const std::string& cell) {
  return fmt::format(R"(<td data-of="{}">{}</td>)", heading, cell.empty() ? "–" : escaped(cell));
}

fs::path table_of(const fs::path& run, const std::string& stage) {
  return run / fmt::format("walls-{}.csv", stage);
}

std::string table_html(const std::string& stage, const store::ReadTable& cells,
                       const run::KnownQuantities& known) {
  std::string html = fmt::format(
      R"(<h3>At the end of stage {}</h3><div class="wide" tabindex="0" role="region" aria-label="Walls"><table><thead><tr>)",
      escaped(stage));
  std::vector<std::string> headings;
  for (const std::string& name : cells.names) {
    headings.push_back(escaped(known.label(name)));
    html += fmt::format(R"(<th scope="col">{}</th>)", headings.back());
  }
  html += "</tr></thead><tbody>";
  for (std::size_t row = 0; row < std::min(cells.rows(), kMaxWalls); ++row) {
    html += fmt::format(R"(<tr><th scope="row">{}</th>)", escaped(cells.cells.front()[row]));
    for (std::size_t column = 1; column < cells.names.size(); ++column) {
      html += cell_html(headings[column], cells.cells[column][row]);
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string walls_html(const fs::path& run, const store::RunSummary& summary, Warnings& warnings) {
  constexpr std::size_t kMaxTables = 24;
  constexpr std::size_t kMaxTableColumns = 30;
  constexpr double kMaxFileBytes = 64 << 20;  // a table takes up to 40 times that in memory
  std::vector<std::string> stages;
  for (const store::StageSummary& stage : summary.stages) {
    if (is_file_name(stage.name) && fs::is_regular_file(table_of(run, stage.name))) {
      stages.push_back(stage.name);
    }
  }
  std::string html;
  for (const std::size_t number : evenly(stages.size(), kMaxTables)) {
    try {
      const auto table = store::read_table(table_of(run, stages[number]), kMaxFileBytes);
      if (table.rows() > 0 && table.names.size() <= kMaxTableColumns) {
        html += table_html(stages[number], table, run::known_quantities(summary));
      }
    } catch (const store::StoreError& error) {
      warnings.add(error.what());
    }
  }
  return html;
}

}  // namespace clca::report
