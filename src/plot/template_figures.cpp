// Figures of the tables that a template needs.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "clca/run/quantity.hpp"
#include "clca/store/file.hpp"
#include "plot/figure_kinds.hpp"
#include "plot/gnuplot.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

/// The source of a figure.
struct Content {
  std::vector<TableFile> files;
  std::vector<std::string> groups;
};

/// The values of a column in order, stages in that of the run; one empty value if there is no such
/// column.
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
  return names.empty() ? std::vector<std::string>{""} : column == "stage" ? names : in_order(names);
}

/// |TABLE:COLUMN| for each column with values; read by has() of the style.
std::string known_columns(RunTables& tables, const Template& figure_template) {
  std::vector<std::string> patterns = figure_template.may_use;
  for (const TableRequirement& need : figure_template.needs) {
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
std::string pattern_text(RunTables& tables, const Template& figure_template,
                         const Content& content) {
  const TableRequirement& need = figure_template.needs.front();
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

std::string setting_text(RunTables& tables, const Template& figure_template,
                         const Content& content) {
  std::vector<std::string> files;
  std::vector<std::string> labels;
  for (const TableFile& file : content.files) {
    files.push_back(file.name);
    labels.push_back(file.label);
  }
  std::string text = array_text("files", files) + array_text("labels", labels) +
                     array_text("groups", content.groups);
  text += fmt::format("group_column = {};", literal(figure_template.groups));
  text += fmt::format("known_columns = {};", literal(known_columns(tables, figure_template)));
  text += quantities_text(tables, content.files);
  text += fmt::format("longest_label = {};", longest_of(content.groups, labels));
  text += pattern_text(tables, figure_template, content);
  text += fmt::format("templates = {};",
                      literal(fs::absolute(figure_template.file).parent_path().string()));
  const auto& units = tables.summary().units;
  text += fmt::format("time_column = {};", literal(units ? "time" : "step"));
  text +=
      fmt::format("velocity_unit = {};", literal(units ? units->velocity_unit : "spacings/step"));
  const auto& box = tables.summary().box;
  text += box ? fmt::format("box_left = {:.17e}; box_right = {:.17e}; periodic = {};", box->left,
                            box->right, box->periodic ? 1 : 0)
              : "box_left = NaN; box_right = NaN; periodic = 0;";
  for (const std::string& measure : figure_template.measures) {
    text += measure_text(tables.summary(), measure);
  }
  return text;
}

/// Whether the rows of a group have a value in each column that the first table needs.
bool has_values_in(RunTables& tables, const Template& figure_template, const Content& content,
                   const std::string& group) {
  TableRequirement need = figure_template.needs.front();
  if (!group.empty()) {
    need.rows.emplace_back(figure_template.groups, group);
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

std::string figure_name(const Template& figure_template, const Content& part) {
  const std::string label = figure_template.division == Division::by_group ? part.groups.front()
                            : figure_template.division == Division::by_file
                                ? part.files.front().label
                                : std::string();
  return label.empty() ? figure_template.name : figure_template.name + "-" + label;
}

/// What the template says, and of which part of the tables this is.
std::string description(const RunTables& tables, const Template& figure_template,
                        const Content& part) {
  if (figure_template.division == Division::by_group && !part.groups.front().empty()) {
    return fmt::format("{} {}: {}.", figure_template.description, figure_template.groups,
                       part.groups.front());
  }
  if (figure_template.division == Division::by_file) {
    const std::string& label = part.files.front().label;
    const bool is_stage =
        std::ranges::count(tables.summary().stages, label, &store::StageSummary::name) > 0;
    return fmt::format("{} {}: {}.", figure_template.description, is_stage ? "Stage" : "Time",
                       label);
  }
  return figure_template.description;
}

}  // namespace

std::vector<Figure> template_figures(RunTables& tables, const Template& figure_template) {
  for (const TableRequirement& need : figure_template.needs) {
    if (tables.files(need).empty()) {
      return {};
    }
  }
  Content whole = {.files = tables.files(figure_template.needs.front()), .groups = {}};
  whole.groups = group_names(tables, whole.files, figure_template.groups);
  if (figure_template.division == Division::by_group) {
    std::erase_if(whole.groups, [&](const std::string& group) {
      return !has_values_in(tables, figure_template, whole, group);
    });
  }
  std::vector<Figure> result;
  for (const Content& part : divided(whole, figure_template.division)) {
    result.push_back({.name = figure_name(figure_template, part),
                      .title = tables.title(),
                      .description = description(tables, figure_template, part),
                      .script = figure_template.file,
                      .run = tables.run(),
                      .setting = setting_text(tables, figure_template, part),
                      .rank = figure_template.rank});
  }
  return result;
}

}  // namespace clca::plot
