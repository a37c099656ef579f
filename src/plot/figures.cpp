#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "clca/plot/plot.hpp"
#include "clca/store/file.hpp"
#include "clca/text/input_error.hpp"
#include "plot/figure_kinds.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

std::vector<Figure> figures_of(RunTables& tables, const Template& figure_template,
                               const Choice& choice) {
  const bool is_chosen = !choice.y.empty();
  const bool is_sweep = tables.summary().kind == "sweep";
  if (figure_template.division == Division::by_measure) {
    return sweep_figures(tables, figure_template, choice);
  }
  if (figure_template.division == Division::by_mean) {
    return is_sweep && choice.x.empty() ? mean_figures(tables, figure_template, choice)
                                        : std::vector<Figure>();
  }
  if (figure_template.division == Division::by_column) {
    return is_chosen && !is_sweep ? column_figures(tables, figure_template, choice)
                                  : std::vector<Figure>();
  }
  return is_chosen ? std::vector<Figure>() : template_figures(tables, figure_template);
}

/// Explains why there is no figure of that name.
std::string reason(const std::vector<Template>& templates, const std::vector<Figure>& possible,
                   const std::string& name) {
  const auto found = std::find_if(templates.begin(), templates.end(),
                                  [&](const Template& any) { return any.name == name; });
  if (found != templates.end()) {
    std::string needs;
    for (const TableRequirement& need : found->needs) {
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
  std::copy_if(
      possible.begin(), possible.end(), std::back_inserter(result), [&](const auto& figure) {
        return only.empty() || std::any_of(only.begin(), only.end(), [&](const std::string& name) {
                 return is_named(figure, name);
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
    for (const Template& figure_template : templates) {
      try {
        const std::vector<Figure> more = figures_of(tables, figure_template, choice);
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
