#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include "clca/plot/plot.hpp"
#include "clca/run/quantity.hpp"
#include "clca/store/file.hpp"
#include "clca/text/input_error.hpp"
#include "clca/text/message.hpp"
#include "plot/gnuplot.hpp"
#include "plot/run_tables.hpp"
#include "plot/sweep_figures.hpp"
#include "plot/template.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

/// The source of a figure.
struct Content {
  std::vector<TableFile> files;
  std::vector<std::string> groups;
};

/// The values of a column in order of appearance; one empty value if there is no such column.
std::vector<std::string> group_names(RunTables& tables, const std::vector<TableFile>& files,
                                     const std::string& column) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const TableFile& file : files) {
    const std::vector<std::string>* cells = tables.read(file.name).find(column);
    for (std::size_t row = 0; cells != nullptr && row < cells->size(); ++row) {
      const std::string& name = (*cells)[row];
      if (!is_label(name)) {
        throw store::StoreError(fmt::format("cannot read {}: line {}: column '{}' holds no name",
                                            tables.read(file.name).file.string(), row + 2, column));
      }
      if (known.insert(name).second) {
        names.push_back(name);
      }
    }
  }
  return names.empty() ? std::vector<std::string>{""} : names;
}

/// |TABLE:COLUMN| for each column with values; read by has() of the style.
std::string known_columns(RunTables& tables, const Template& one) {
  std::vector<std::string> patterns = one.may_use;
  for (const TableRequirement& need : one.needs) {
    patterns.push_back(need.table);
  }
  std::set<std::string> known;
  for (const std::string& pattern : patterns) {
    for (const TableFile& file : tables.files(pattern)) {
      const store::ReadTable& table = tables.read(file.name);
      for (const std::string& column : table.names) {
        if (has_values(table, column, {})) {
          known.insert(fmt::format("{}:{}", pattern, column));
        }
      }
    }
  }
  std::string text = "|";
  for (const std::string& column : known) {
    text += column + "|";
  }
  return text;
}

/// Value of the last stage that has it.
std::string measure_text(const store::RunSummary& summary, const std::string& name) {
  std::string value = "NaN";
  for (const store::StageSummary& stage : summary.stages) {
    for (const auto& [measure, what] : stage.measures) {
      if (const auto* number = std::get_if<double>(&what); number != nullptr && measure == name) {
        value = fmt::format("{:.17e}", *number);
      }
    }
  }
  return fmt::format("{} = {};", name, value);
}

/// Of what may stand in a legend; in characters, with a word beside it.
std::size_t longest_of(const std::vector<std::string>& groups,
                       const std::vector<std::string>& labels) {
  constexpr std::size_t kWord = 7;
  std::size_t longest = 0;
  for (const auto* texts : {&groups, &labels}) {
    for (const std::string& text : *texts) {
      longest = std::max(longest, text.size());
    }
  }
  return longest + kWord;
}

/// Columns that a pattern of the first table stands for, and what its `*` does.
std::string pattern_text(RunTables& tables, const Template& one, const Content& content) {
  const TableRequirement& need = one.needs.front();
  std::vector<std::string> columns;
  std::vector<std::string> labels;
  for (const std::string& pattern : need.columns) {
    if (pattern.ends_with('*')) {
      columns = matching_columns(tables.read(content.files.front().name), pattern, need);
      for (const std::string& column : columns) {
        labels.push_back(column.substr(pattern.size() - 1));
      }
    }
  }
  return columns.empty() ? std::string()
                         : array_text("columns", columns) + array_text("column_labels", labels);
}

/// The labels of axes for all columns of these files.
std::string quantities_text(RunTables& tables, const std::vector<TableFile>& files) {
  const run::KnownQuantities known = run::known_quantities(tables.summary());
  std::vector<std::string> keys = {""};  // an array has at least one value
  std::vector<std::string> names = {""};
  for (const TableFile& file : files) {
    for (const std::string& column : tables.read(file.name).names) {
      for (const std::string& key : {column, column.substr(0, column.find('.'))}) {
        if (std::ranges::count(keys, key) == 0) {
          keys.push_back(key);
          names.push_back(known.label(key));
        }
      }
    }
  }
  return array_text("quantity_keys", keys) + array_text("quantity_labels", names);
}

std::string setting_text(RunTables& tables, const Template& one, const Content& content) {
  std::vector<std::string> files;
  std::vector<std::string> labels;
  for (const TableFile& file : content.files) {
    files.push_back(file.name);
    labels.push_back(file.label);
  }
  std::string text = array_text("files", files) + array_text("labels", labels) +
                     array_text("groups", content.groups);
  text += fmt::format("group_column = {};", literal(one.groups));
  text += fmt::format("known_columns = {};", literal(known_columns(tables, one)));
  text += quantities_text(tables, content.files);
  text += fmt::format("longest_label = {};", longest_of(content.groups, labels));
  text += pattern_text(tables, one, content);
  text += fmt::format("templates = {};", literal(fs::absolute(one.file).parent_path().string()));
  const auto& units = tables.summary().units;
  text += fmt::format("time_column = {};", literal(units ? "time" : "step"));
  text += fmt::format("time_title = {};",
                      literal(units ? fmt::format("Time ({})", units->time_unit) : "Step"));
  text +=
      fmt::format("velocity_unit = {};", literal(units ? units->velocity_unit : "spacings/step"));
  const auto& box = tables.summary().box;
  text += box ? fmt::format("box_left = {:.17e}; box_right = {:.17e}; periodic = {};", box->left,
                            box->right, box->periodic ? 1 : 0)
              : "box_left = NaN; box_right = NaN; periodic = 0;";
  for (const std::string& measure : one.measures) {
    text += measure_text(tables.summary(), measure);
  }
  return text;
}

/// Whether the rows of a group have a value in each column that the first table needs.
bool has_values_in(RunTables& tables, const Template& one, const Content& content,
                   const std::string& group) {
  TableRequirement need = one.needs.front();
  if (!group.empty()) {
    need.rows.emplace_back(one.groups, group);
  }
  return std::all_of(need.columns.begin(), need.columns.end(), [&](const std::string& column) {
    return std::any_of(content.files.begin(), content.files.end(), [&](const TableFile& file) {
      return !matching_columns(tables.read(file.name), column, need).empty();
    });
  });
}

std::vector<Content> divided(const Content& whole, Division division) {
  std::vector<Content> parts;
  if (division == Division::by_group) {
    for (const std::string& group : whole.groups) {
      parts.push_back({whole.files, {group}});
    }
  } else if (division == Division::by_file) {
    for (const TableFile& file : whole.files) {
      parts.push_back({{file}, whole.groups});
    }
  } else {
    parts.push_back(whole);
  }
  return parts;
}

std::string figure_name(const Template& one, const Content& part) {
  const std::string label = one.division == Division::by_group  ? part.groups.front()
                            : one.division == Division::by_file ? part.files.front().label
                                                                : std::string();
  return label.empty() ? one.name : one.name + "-" + label;
}

/// What the template says, and of which part of the tables this is.
std::string description(const RunTables& tables, const Template& one, const Content& part) {
  if (one.division == Division::by_group && !part.groups.front().empty()) {
    return fmt::format("{} {}: {}.", one.description, one.groups, part.groups.front());
  }
  if (one.division == Division::by_file) {
    const std::string& label = part.files.front().label;
    const bool is_stage =
        std::ranges::count(tables.summary().stages, label, &store::StageSummary::name) > 0;
    return fmt::format("{} {}: {}.", one.description, is_stage ? "Stage" : "Time", label);
  }
  return one.description;
}

/// Empty if the tables lack something.
std::vector<Figure> figures_of(RunTables& tables, const Template& one) {
  for (const TableRequirement& need : one.needs) {
    if (tables.files(need).empty()) {
      return {};
    }
  }
  Content whole = {.files = tables.files(one.needs.front()), .groups = {}};
  whole.groups = group_names(tables, whole.files, one.groups);
  if (one.division == Division::by_group) {
    std::erase_if(whole.groups, [&](const std::string& group) {
      return !has_values_in(tables, one, whole, group);
    });
  }
  std::vector<Figure> result;
  for (const Content& part : divided(whole, one.division)) {
    result.push_back({.name = figure_name(one, part),
                      .title = tables.title(),
                      .description = description(tables, one, part),
                      .script = one.file,
                      .run = tables.run(),
                      .setting = setting_text(tables, one, part),
                      .rank = one.rank});
  }
  return result;
}

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

/// Of a run: a figure for each chosen column, with a curve for each value of another one.
std::vector<Figure> column_figures(RunTables& tables, const Template& one, const Choice& choice) {
  std::vector<Figure> result;
  for (const std::string& y : choice.y) {
    std::vector<std::string> columns = choice.over;
    columns.push_back(y);
    if (!choice.x.empty()) {
      columns.push_back(choice.x);
    }
    const std::string table = table_with(tables, columns);
    const std::vector<std::string>& names = tables.read(table).names;
    Template chosen = one;
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
    for (Figure& figure : figures_of(tables, chosen)) {
      figure.setting += more;
      result.push_back(std::move(figure));
    }
  }
  return result;
}

std::vector<Figure> figures_of(RunTables& tables, const Template& one, const Choice& choice) {
  const bool is_chosen = !choice.y.empty();
  const bool is_sweep = tables.summary().kind == "sweep";
  if (one.division == Division::by_measure) {
    return sweep_figures(tables, one, choice);
  }
  if (one.division == Division::by_mean) {
    return is_sweep && choice.x.empty() ? mean_figures(tables, one, choice) : std::vector<Figure>();
  }
  if (one.division == Division::by_column) {
    return is_chosen && !is_sweep ? column_figures(tables, one, choice) : std::vector<Figure>();
  }
  return is_chosen ? std::vector<Figure>() : figures_of(tables, one);
}

/// Explains why there is no figure of that name.
std::string reason(const std::vector<Template>& templates, const std::vector<Figure>& possible,
                   const std::string& name) {
  const auto one = std::find_if(templates.begin(), templates.end(),
                                [&](const Template& any) { return any.name == name; });
  if (one != templates.end()) {
    std::string needs;
    for (const TableRequirement& need : one->needs) {
      needs += (needs.empty() ? "" : "; ") + to_text(need);
    }
    return fmt::format("the tables do not allow the figure '{}', which needs {}", name, needs);
  }
  std::string names;
  for (const Figure& figure : possible) {
    names += (names.empty() ? "" : ", ") + figure.name;
  }
  return fmt::format("no figure '{}' (there are: {})", name, names);
}

bool is_named(const Figure& figure, const std::string& name) {
  return figure.name == name || figure.script.stem() == name;
}

std::vector<Figure> chosen(const std::vector<Figure>& possible,
                           const std::vector<std::string>& only) {
  std::vector<Figure> result;
  std::copy_if(possible.begin(), possible.end(), std::back_inserter(result), [&](const auto& one) {
    return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& name) {
             return is_named(one, name);
           });
  });
  return result;
}

/// `unreadable` is called where the tables of a template are invalid.
std::vector<Figure> possible_figures(
    const fs::path& run, const std::vector<Template>& templates, const Choice& choice,
    const std::function<void(const store::StoreError&)>& unreadable) {
  try {
    RunTables tables(run);
    const bool chooses = !choice.x.empty() || !choice.over.empty() || choice.log_x || choice.log_y;
    if (chooses && choice.y.empty() && tables.summary().kind != "sweep") {
      throw text::InputError(
          fmt::format("{}: of a run, say which columns are y, too", run.string()));
    }
    std::vector<Figure> all;
    for (const Template& one : templates) {
      try {
        const std::vector<Figure> more = figures_of(tables, one, choice);
        all.insert(all.end(), more.begin(), more.end());
      } catch (const store::StoreError& error) {
        unreadable(error);
      }
    }
    return all;
  } catch (const store::StoreError& error) {
    throw text::InputError(error.what());
  }
}

}  // namespace

std::vector<Figure> figures(const fs::path& run, const std::vector<std::string>& only,
                            const fs::path& templates, const Choice& choice) {
  const std::vector<Template> known = read_templates(templates);
  const std::vector<Figure> possible =
      possible_figures(run, known, choice, [](const store::StoreError& error) { throw error; });
  if (possible.empty()) {
    throw text::InputError(
        fmt::format("{}: no tables that a figure could be drawn from", run.string()));
  }
  for (const std::string& name : only) {
    if (std::none_of(possible.begin(), possible.end(),
                     [&](const Figure& figure) { return is_named(figure, name); })) {
      throw text::InputError(fmt::format("{}: {}", run.string(), reason(known, possible, name)));
    }
  }
  return chosen(possible, only);
}

std::vector<Figure> figures_of_readable_tables(
    const fs::path& run, const fs::path& templates,
    const std::function<void(const std::string&)>& warning) {
  std::vector<Figure> all =
      possible_figures(run, read_templates(templates), {},
                       [&](const store::StoreError& error) { warning(error.what()); });
  std::ranges::stable_sort(all, std::ranges::greater(), &Figure::rank);
  return all;
}

}  // namespace clca::plot
