#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"
#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "report/sections.hpp"
#include "report/text.hpp"

namespace clca::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kMaxBytes = 64 << 20;  // of a file
constexpr std::size_t kMaxColumns = 16;
constexpr std::size_t kMaxOverviewColumns = 8;
constexpr std::size_t kMaxRuns = 500;

/// sweep.json and its tables.
struct Sweep {
  fs::path folder;
  std::string scene;                   ///< its file
  std::string title = {};              ///< of the scene; empty if it varies
  std::vector<std::string> keys = {};  ///< that vary
  std::string command;                 ///< that runs it
  std::uint64_t runs = 0;
  store::ReadTable table;  ///< runs.csv
};

Sweep read_sweep(const fs::path& folder) {
  const fs::path file = folder / "sweep.json";
  try {
    const std::vector<std::uint8_t> bytes = store::read_whole(file, kMaxBytes);
    const Json json = Json::parse(bytes.begin(), bytes.end());
    Sweep sweep = {.folder = folder,
                   .scene = json.at("scene"),
                   .title = json.value("title", ""),
                   .command = "clca sweep " + text::shell_word(json.at("scene").get<std::string>()),
                   .runs = json.at("runs"),
                   .table = store::read_table(folder / "runs.csv", kMaxBytes)};
    const auto add = [&](const char* option, const std::string& value) {
      sweep.command += fmt::format(" {} {}", option, text::shell_word(value));
    };
    for (const std::string item : json.at("set")) {
      add("--set", item);
    }
    for (const Json& varied : json.at("vary")) {
      const std::vector<std::string> keys = varied.at("keys");
      const std::vector<std::vector<std::string>> rows = varied.at("rows");
      sweep.keys.insert(sweep.keys.end(), keys.begin(), keys.end());
      std::vector<std::string> values;
      for (const std::vector<std::string>& row : rows) {
        values.push_back(fmt::format("{}", fmt::join(row, ",")));
      }
      add("--vary", fmt::format("{}={}", fmt::join(keys, ","),
                                fmt::join(values, keys.size() == 1 ? "," : "; ")));
    }
    add("--seeds", json.at("seeds"));
    for (const std::string& name : sweep.keys) {
      if (sweep.table.find(name) == nullptr) {
        throw text::InputError(fmt::format("cannot read {}: no column {}",
                                           sweep.table.file.string(), text::printable(name)));
      }
    }
    return sweep;
  } catch (const Json::exception&) {
    throw text::InputError(fmt::format("cannot read {}: it is damaged", file.string()));
  } catch (const store::StoreError& error) {
    throw text::InputError(error.what());
  }
}

/// Cell of a column, or empty where there is none.
std::string cell(const store::ReadTable& table, const std::string& name, std::size_t row) {
  const std::vector<std::string>* column = table.find(name);
  return column == nullptr ? "" : (*column)[row];
}

std::size_t count(const Sweep& sweep, const std::string& status) {
  const std::vector<std::string>* column = sweep.table.find("status");
  return column == nullptr
             ? 0
             : static_cast<std::size_t>(std::count(column->begin(), column->end(), status));
}

/// Of some run that is done.
std::optional<store::RunSummary> some_summary(const Sweep& sweep) {
  for (std::size_t row = 0; row < sweep.table.rows(); ++row) {
    if (cell(sweep.table, "status", row) == "done") {
      try {
        return store::read_summary(sweep.folder / cell(sweep.table, "folder", row) / "run.json");
      } catch (const store::StoreError&) {
        return std::nullopt;
      }
    }
  }
  return std::nullopt;
}

std::vector<std::string> distinct(const std::vector<std::string>& texts) {
  std::vector<std::string> result;
  for (const std::string& text : texts) {
    if (std::find(result.begin(), result.end(), text) == result.end()) {
      result.push_back(text);
    }
  }
  return result;
}

std::string overview_html(const Sweep& sweep, Warnings& warnings) {
  const fs::path file = sweep.folder / "overview.png";
  std::error_code error;
  if (!fs::exists(file, error)) {
    return {};
  }
  const std::vector<std::string>* seeds = sweep.table.find("seed");
  const std::size_t several = seeds != nullptr ? distinct(*seeds).size() : 1;
  const std::size_t columns =
      std::min<std::size_t>(several > 1 ? several : sweep.table.rows(), kMaxOverviewColumns);
  try {
    return fmt::format(
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Overview\"><img "
        "class=\"overview\" style=\"min-width: {}rem\" alt=\"The final pictures of the runs\" "
        "src=\"data:image/png;base64,{}\"></div>\n",
        8 * columns, base64(store::read_whole(file, kMaxBytes)));
  } catch (const store::StoreError& problem) {
    warnings.add(problem.what());
    return {};
  }
}

/// KEY=VALUE of a row, a line each.
std::string combination(const store::ReadTable& table, const std::vector<std::string>& keys,
                        std::size_t row) {
  std::string text;
  for (const std::string& key : keys) {
    text += fmt::format("{}{}={}", text.empty() ? "" : "\n", key, cell(table, key, row));
  }
  return text;
}

/// A key of a scene, KEY=VALUE or a heading; a line may end behind the dots of a key and `=`.
std::string breakable(const std::string& line, const char* end = "<wbr>") {
  const std::string text = escaped(line);
  std::string html;
  for (std::size_t i = 0; i < text.size(); ++i) {
    html += text[i];
    const bool goes_on =
        i + 1 < text.size() && std::isalpha(static_cast<unsigned char>(text[i + 1])) != 0;
    html += text[i] == '=' || (text[i] == '.' && goes_on) ? end : "";
  }
  return html;
}

std::string lines_html(const std::string& text) {
  std::string html;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    html += (html.empty() ? "" : "<br>") + breakable(line);
  }
  return html;
}

/// A table of one stage: a row for each measure, a column for each combination.
class StageTable {
 public:
  StageTable(const store::ReadTable& table, std::vector<std::string> columns,
             const std::vector<std::string>& column_of_row, run::KnownQuantities known)
      : table_(table),
        columns_(std::move(columns)),
        column_of_row_(column_of_row),
        means_(table.numbers("mean")),
        errors_(table.numbers("standard_error")),
        known_(std::move(known)) {}

  std::string html(const std::string& stage) const {
    const std::vector<std::string>& stages = *table_.find("stage");
    const std::vector<std::string>& measures = *table_.find("measure");
    std::vector<std::string> names;
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      if (stages[row] == stage) {
        names.push_back(measures[row]);
      }
    }
    const std::vector<double> angles = cells(stage, std::string(run::kVesselAngleKey)).means;
    std::string body;
    for (const std::string& name : distinct(names)) {
      body += row_html(stage, name, angles);
    }
    std::string head = R"(<tr><th scope="col">Measure</th>)";
    for (const std::string& column : columns_) {
      head +=
          fmt::format(R"(<th scope="col">{}</th>)", column.empty() ? "Mean" : lines_html(column));
    }
    return fmt::format(
        R"(<h3>{}</h3>
<div class="wide" tabindex="0" role="region" aria-label="Measures"><table><thead>{}<th scope="col" class="unit">Unit</th><th scope="col" class="key">In measures.csv</th></tr></thead><tbody>
{}</tbody></table></div>
{})",
        escaped(stage), head, body, std::ranges::any_of(angles, is_turned) ? kTurnedNote : "");
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  static bool is_turned(double angle) { return !std::isnan(angle) && angle != 0; }

  /// Of a measure, by column.
  struct Cells {
    std::vector<double> means;
    std::vector<double> errors;
  };
  Cells cells(const std::string& stage, const std::string& measure) const {
    Cells cells = {std::vector(columns_.size(), kNone), std::vector(columns_.size(), kNone)};
    for (std::size_t row = 0; row < table_.rows(); ++row) {
      const auto column = std::find(columns_.begin(), columns_.end(), column_of_row_[row]);
      if (column != columns_.end() && cell(table_, "stage", row) == stage &&
          cell(table_, "measure", row) == measure) {
        const auto number = static_cast<std::size_t>(column - columns_.begin());
        cells.means[number] = means_[row];
        cells.errors[number] = errors_[row];
      }
    }
    return cells;
  }

  /// `angles`: of the vessel, by column. Empty if there is none to show.
  std::string row_html(const std::string& stage, const std::string& measure,
                       const std::vector<double>& angles) const {
    auto [means, errors] = cells(stage, measure);
    const auto known = known_.find(measure);
    if (known && known->of_floor) {
      if (std::ranges::all_of(angles, is_turned)) {
        return {};
      }
      for (std::size_t i = 0; i < means.size(); ++i) {
        means[i] = is_turned(angles[i]) ? kNone : means[i];
        errors[i] = is_turned(angles[i]) ? kNone : errors[i];
      }
    }
    std::string html = "<tr>" + measure_heading(measure, known);
    const int decimals = decimals_for(means, errors);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      html += fmt::format(R"(<td data-of="{}">{}</td>)",
                          columns_[i].empty() ? "Mean" : breakable(columns_[i], "&#8203;"),
                          std::isnan(means[i]) ? "–" : number_html(means[i], errors[i], decimals));
    }
    return html + fmt::format(
                      R"(<td class="unit">{}</td><td class="key"><code>{}</code></td></tr>
)",
                      escaped(known ? known->unit : ""), escaped(measure));
  }

  const store::ReadTable& table_;
  std::vector<std::string> columns_;
  const std::vector<std::string>& column_of_row_;
  std::vector<double> means_;
  std::vector<double> errors_;
  run::KnownQuantities known_;
};

std::string measures_html(const Sweep& sweep, const run::KnownQuantities& known,
                          Warnings& warnings) {
  try {
    const store::ReadTable table = store::read_table(sweep.folder / "measures.csv", kMaxBytes);
    if (table.find("stage") == nullptr || table.find("measure") == nullptr) {
      throw store::StoreError(
          fmt::format("cannot read {}: no table of measures", table.file.string()));
    }
    std::vector<std::string> column_of_row;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      column_of_row.push_back(combination(table, sweep.keys, row));
    }
    const std::vector<std::string> all = distinct(column_of_row);
    std::vector<std::string> columns;
    for (const std::size_t number : evenly(all.size(), kMaxColumns)) {
      columns.push_back(all[number]);
    }
    const StageTable tables(table, columns, column_of_row, known);
    std::string html =
        "<p>Means over the seeds; ± is one standard error. All combinations are in "
        "<code>measures.csv</code>.</p>\n";
    for (const std::string& stage : distinct(*table.find("stage"))) {
      html += tables.html(stage);
    }
    return html;
  } catch (const store::StoreError& error) {
    warnings.add(error.what());
    return {};
  }
}

std::string runs_html(const Sweep& sweep, const run::KnownQuantities& known) {
  std::vector<std::string> names = sweep.keys;
  std::vector<std::string> headings = sweep.keys;
  for (const char* name : {"seed", "status", "steps", "state_hash", "error"}) {
    names.emplace_back(name);
    headings.push_back(known.label(name));
  }
  std::string html =
      R"(<div class="wide" tabindex="0" role="region" aria-label="Runs"><table><thead><tr>)";
  for (const std::string& heading : headings) {
    html += fmt::format(R"(<th scope="col">{}</th>)", breakable(heading));
  }
  html += "</tr></thead><tbody>\n";
  const std::size_t shown = std::min(sweep.table.rows(), kMaxRuns);
  for (std::size_t row = 0; row < shown; ++row) {
    html += "<tr>";
    for (std::size_t column = 0; column < names.size(); ++column) {
      html += fmt::format(R"(<td data-of="{}">{}</td>)", escaped(headings[column]),
                          escaped(cell(sweep.table, names[column], row)));
    }
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  if (shown < sweep.table.rows()) {
    html += fmt::format(
        "<p class=\"note\">The first {} of {} runs; all are in <code>runs.csv</code>.</p>\n", shown,
        sweep.table.rows());
  }
  return html;
}

std::string command_html(const Sweep& sweep) {
  return fmt::format(
      "<p>The same scene and seeds give the same bits, with any number of jobs:</p>\n"
      "<pre>{}</pre>\n",
      escaped(sweep.command));
}

}  // namespace

Page sweep_page(const fs::path& folder, Warnings& warnings) {
  const Sweep sweep = read_sweep(folder);
  const std::optional<store::RunSummary> summary = some_summary(sweep);
  run::KnownQuantities known = run::known_quantities(summary.value_or(store::RunSummary()));
  known.of = run::KnownQuantities::Of::sweep;
  for (scene::DerivedMeasure& derived : known.derived) {
    derived.value.clear();  // whose numbers may vary
  }
  const std::size_t done = count(sweep, "done");
  const std::size_t failed = count(sweep, "failed");
  const std::string scene = summary ? summary->scene : fs::path(sweep.scene).stem().string();
  return {.title = sweep.title.empty() ? scene : sweep.title,
          .kind = "Sweep: runs with varied values and seeds",
          .status = done == sweep.runs ? "done" : "incomplete",
          .scene = scene,
          .facts = {{"Varied", sweep.keys.empty()
                                   ? "seed"
                                   : breakable(fmt::format("{}", fmt::join(sweep.keys, ", ")))},
                    {"Runs", whole(sweep.runs)},
                    {"Done", whole(done)},
                    {"Failed", whole(failed)}},
          .sections = {{"pictures", "Pictures", overview_html(sweep, warnings)},
                       {"figures", "Figures", figures_html(folder, warnings)},
                       {"measures", "Measures", measures_html(sweep, known, warnings)},
                       {"runs", "Runs", runs_html(sweep, known)},
                       {"repeat", "How to repeat it", command_html(sweep)},
                       {"files", "Tables", files_html(folder)}}};
}

}  // namespace clca::report
