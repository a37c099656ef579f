#include "plot/sweep_figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "clca/run/quantity.hpp"
#include "clca/text/message.hpp"
#include "plot/gnuplot.hpp"

namespace clca::plot {

namespace {

using Cells = std::vector<std::string>;

/// The values in order of appearance.
Cells distinct(const Cells& cells) {
  Cells result;
  std::set<std::string> known;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(result),
               [&](const std::string& cell) { return known.insert(cell).second; });
  return result;
}

bool is_number(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// Whether two keys vary together: each value of the first comes with one of the second.
bool vary_together(const Cells& first, const Cells& second) {
  std::set<std::pair<std::string, std::string>> pairs;
  for (std::size_t row = 0; row < first.size(); ++row) {
    pairs.emplace(first[row], second[row]);
  }
  return pairs.size() == distinct(first).size() && pairs.size() == distinct(second).size();
}

/// KEY=VALUE, KEY=VALUE of the keys but the first and those that vary with it, for each row.
Cells curve_labels(const store::ReadTable& table, std::size_t keys) {
  Cells lines(table.rows());
  for (std::size_t key = 1; key < keys; ++key) {
    if (!vary_together(table.cells[0], table.cells[key])) {
      for (std::size_t row = 0; row < lines.size(); ++row) {
        lines[row] += fmt::format("{}{}={}", lines[row].empty() ? "" : ", ", table.names[key],
                                  table.cells[key][row]);
      }
    }
  }
  return lines;
}

/// So that they stand side by side under an axis.
Cells shortened(const Cells& words) {
  constexpr std::size_t kAxis = 72;  // characters
  const std::size_t most = std::max<std::size_t>(kAxis / std::max<std::size_t>(words.size(), 1), 4);
  Cells result;
  for (const std::string& word : words) {
    const std::string_view beginning = text::first_characters(word, most);
    result.push_back(std::string(beginning) + (beginning.size() < word.size() ? "…" : ""));
  }
  return result;
}

std::string number_array_text(const std::string& name, const Cells& numbers) {
  return fmt::format("array {}[{}] = [{}];", name, numbers.size(), fmt::join(numbers, ", "));
}

std::string position_of(const Cells& all, const std::string& one) {
  return fmt::format("{}", std::find(all.begin(), all.end(), one) - all.begin() + 1);
}

/// The rows of one stage and measure.
struct Points {
  Cells xs;
  Cells means;
  Cells lows;
  Cells highs;
  Cells lines;  ///< numbers of lines, from 1
};

std::string setting_of(const Points& points) {
  return number_array_text("xs", points.xs) + number_array_text("means", points.means) +
         number_array_text("lows", points.lows) + number_array_text("highs", points.highs) +
         number_array_text("of_lines", points.lines);
}

}  // namespace

std::vector<Figure> sweep_figures(RunTables& tables, const Template& one) {
  const TableRequirement& need = one.needs.front();
  const std::vector<TableFile> files = tables.files(need);
  if (files.empty()) {
    return {};
  }
  const store::ReadTable& table = tables.read(files.front().name);
  const Cells* stages = table.find("stage");
  const Cells* measures = table.find("measure");
  const Cells* means = table.find("mean");
  const Cells* lows = table.find("low");
  const Cells* highs = table.find("high");
  const auto keys = static_cast<std::size_t>(
      std::find(table.names.begin(), table.names.end(), "stage") - table.names.begin());
  if (stages == nullptr || measures == nullptr || means == nullptr || lows == nullptr ||
      highs == nullptr || keys == 0) {
    return {};  // only the seed varies
  }
  const Cells& values = table.cells.front();
  const Cells words = distinct(values);
  const bool has_words = !std::all_of(words.begin(), words.end(), is_number);
  const run::KnownQuantities known = run::known_quantities(tables.summary());
  const Cells labels = curve_labels(table, keys);
  const Cells lines = distinct(labels);
  std::vector<std::pair<std::size_t, Points>> found;  // by first row, in the order of the table
  std::map<std::pair<std::string, std::string>, std::size_t> numbers;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!is_number((*means)[row]) || !is_label((*stages)[row]) || !is_label((*measures)[row])) {
      continue;
    }
    const auto [at, is_new] =
        numbers.emplace(std::pair((*stages)[row], (*measures)[row]), found.size());
    if (is_new) {
      found.emplace_back(row, Points());
    }
    Points& points = found[at->second].second;
    points.xs.push_back(has_words ? position_of(words, values[row]) : values[row]);
    points.means.push_back((*means)[row]);
    const bool has_errors = is_number((*lows)[row]) && is_number((*highs)[row]);
    points.lows.push_back(has_errors ? (*lows)[row] : (*means)[row]);
    points.highs.push_back(has_errors ? (*highs)[row] : (*means)[row]);
    points.lines.push_back(position_of(lines, labels[row]));
  }
  std::vector<Figure> result;
  for (const auto& [row, points] : found) {
    result.push_back(
        {.name = fmt::format("{}-{}-{}", one.name, (*stages)[row], (*measures)[row]),
         .title = tables.title(),
         .description = one.description,
         .script = one.file,
         .run = tables.run(),
         .setting =
             array_text("files", {files.front().name}) + array_text("groups", {""}) +
             fmt::format("known_columns = '|'; time_column = 'step'; varied = {}; has_words = {};"
                         "stage = {}; measure = {}; measure_label = {};",
                         literal(table.names.front()), has_words ? 1 : 0, literal((*stages)[row]),
                         literal((*measures)[row]), literal(known.label((*measures)[row]))) +
             array_text("words", shortened(words)) + array_text("lines", lines) +
             setting_of(points)});
  }
  return result;
}

}  // namespace clca::plot
