// Figures of chosen columns of a run.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "plot/figure_kinds.hpp"
#include "plot/gnuplot.hpp"

namespace clca::plot {

namespace {

/// The first table that has all these columns: the series, else in alphabetical order.
std::string table_with(RunTables& tables, const std::vector<std::string>& columns) {
  std::vector<TableFile> files = tables.files("*.csv");
  std::stable_partition(files.begin(), files.end(),
                        [](const TableFile& file) { return file.name == "series.csv"; });
  std::vector<std::string> known;
  for (const TableFile& file : files) {
    const std::vector<std::string>& names = tables.read(file.name).names;
    if (std::ranges::all_of(columns, [&](const std::string& column) {
          return std::ranges::count(names, column) > 0;
        })) {
      return file.name;
    }
    known.insert(known.end(), names.begin(), names.end());
  }
  const std::vector<std::string_view> views(known.begin(), known.end());
  for (const std::string& column : columns) {
    if (std::ranges::count(known, column) == 0) {
      throw text::InputError(fmt::format("{}: no table with a column {}{}", tables.run().string(),
                                         text::shown(column), text::suggestion(column, views)));
    }
  }
  throw text::InputError(fmt::format("{}: no table with all of the columns {}",
                                     tables.run().string(), fmt::join(columns, ", ")));
}

}  // namespace

std::vector<Figure> column_figures(RunTables& tables, const Template& figure_template,
                                   const Choice& choice) {
  if (choice.over.size() > 1) {
    throw text::InputError(
        fmt::format("{}: of a run, a curve is drawn for each value of one column, not of {}",
                    tables.run().string(), fmt::join(choice.over, " and ")));
  }
  std::vector<Figure> result;
  for (const std::string& y : choice.y) {
    std::vector<std::string> columns = choice.over;
    columns.push_back(y);
    if (!choice.x.empty()) {
      columns.push_back(choice.x);
    }
    const std::string table = table_with(tables, columns);
    const std::vector<std::string>& names = tables.read(table).names;
    Template chosen = figure_template;
    TableRequirement need;
    need.table = table;
    need.columns = {y};
    chosen.needs = {need};
    for (const char* group : {"stage", "restitution", "probe", "line"}) {
      if (choice.over.empty() && std::ranges::count(names, group) > 0) {
        chosen.groups = group;
      }
    }
    if (!choice.over.empty()) {
      chosen.groups = choice.over.front();
    }
    std::string x = choice.x;
    for (const char* column : {"cycle", "step", "time"}) {
      if (choice.x.empty() && std::ranges::count(names, column) > 0) {
        x = column;
      }
    }
    if (x.empty()) {
      throw text::InputError(
          fmt::format("{}: say which column of {} is x", tables.run().string(), table));
    }
    for (const std::string& column : {x, y}) {
      tables.read(table).numbers(column);
    }
    chosen.division = Division::none;
    chosen.name = y;
    const std::string more =
        fmt::format("x_column = {}; y_column = {}; log_axes = '{}{}';", literal(x), literal(y),
                    choice.log_x ? "x" : "", choice.log_y ? "y" : "");
    for (Figure& figure : template_figures(tables, chosen)) {
      figure.setting += more;
      result.push_back(std::move(figure));
    }
  }
  return result;
}

}  // namespace clca::plot
