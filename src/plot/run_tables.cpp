#include "plot/run_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>
#include <tuple>

#include "clca/store/file.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> file_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    names.push_back(it->path().filename().string());
  }
  if (error) {
    throw store::StoreError(
        fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
  }
  return names;
}

/// The title in a sweep.json; empty if there is none.
std::string sweep_title(const fs::path& file) {
  constexpr double kMaxBytes = 1 << 24;
  const auto bytes = store::read_whole(file, kMaxBytes);
  const auto json = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
  return json.is_object() && json.contains("title") && json["title"].is_string()
             ? json["title"].get<std::string>()
             : "";
}

/// Of some run of a sweep; an empty one if there is none that is done.
store::RunSummary some_summary(const fs::path& folder) {
  try {
    const store::ReadTable runs = store::read_table(folder / "runs.csv");
    const std::vector<std::string>* status = runs.find("status");
    const std::vector<std::string>* folders = runs.find("folder");
    for (std::size_t row = 0; status != nullptr && folders != nullptr && row < runs.rows(); ++row) {
      if ((*status)[row] == "done") {
        return store::read_summary(folder / (*folders)[row] / "run.json");
      }
    }
  } catch (const store::StoreError&) {  // names and units are those of declared quantities
  }
  return {};
}

/// Of a sweep, which has no run.json: its title and the name of its folder; units, stages and
/// derived measures as of some run.
store::RunSummary summary_of(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "sweep.json", error) && !fs::exists(folder / "run.json", error)) {
    const store::RunSummary of_run = some_summary(folder);
    store::RunSummary summary;
    summary.kind = "sweep";
    summary.scene = fs::weakly_canonical(folder, error).filename().string();
    summary.title = sweep_title(folder / "sweep.json");
    summary.units = of_run.units;
    summary.stages = of_run.stages;
    summary.derived = of_run.derived;
    for (scene::DerivedMeasure& derived : summary.derived) {
      derived.value.clear();  // whose numbers may vary
    }
    return summary;
  }
  return store::read_summary(folder / "run.json");
}

/// Stages in order of the run, times ascending, all else alphabetical.
auto order(const store::RunSummary& summary, const std::string& label) {
  const auto stage = std::find_if(summary.stages.begin(), summary.stages.end(),
                                  [&](const auto& named) { return named.name == label; });
  double number = 0;
  std::from_chars(label.data(), label.data() + label.size(), number);
  return std::tuple(stage - summary.stages.begin(), number, label);
}

bool is_row(const store::ReadTable& table, std::size_t row, const TableRequirement& need) {
  return std::all_of(need.rows.begin(), need.rows.end(), [&](const auto& wanted) {
    const std::vector<std::string>* cells = table.find(wanted.first);
    return cells != nullptr && (*cells)[row] == wanted.second;
  });
}

}  // namespace

bool is_label(const std::string& text) {
  constexpr std::string_view kLetters =
      "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_-+.";
  return !text.empty() && text.find_first_not_of(kLetters) == std::string::npos;
}

bool is_number(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> in_order(const std::vector<std::string>& values) {
  std::vector<std::string> result;
  std::set<std::string> known;
  std::ranges::copy_if(values, std::back_inserter(result),
                       [&](const std::string& value) { return known.insert(value).second; });
  if (std::ranges::all_of(result, is_number)) {
    std::ranges::stable_sort(result, {}, [](const std::string& value) { return std::stod(value); });
  }
  return result;
}

bool has_values(const store::ReadTable& table, const std::string& column,
                const TableRequirement& need) {
  const std::vector<std::string>* cells = table.find(column);
  for (std::size_t row = 0; cells != nullptr && row < cells->size(); ++row) {
    const std::string& cell = (*cells)[row];
    if (!cell.empty() && cell != "0" && is_row(table, row, need)) {
      return true;
    }
  }
  return false;
}

std::vector<std::string> matching_columns(const store::ReadTable& table, const std::string& column,
                                          const TableRequirement& need) {
  if (!column.ends_with('*')) {
    return has_values(table, column, need) ? std::vector{column} : std::vector<std::string>();
  }
  const std::string prefix = column.substr(0, column.size() - 1);
  std::vector<std::string> names;
  std::copy_if(table.names.begin(), table.names.end(), std::back_inserter(names),
               [&](const std::string& name) {
                 return name.starts_with(prefix) && is_label(name.substr(prefix.size())) &&
                        has_values(table, name, need);
               });
  return names;
}

RunTables::RunTables(const fs::path& run)
    : run_(run), summary_(summary_of(run)), names_(file_names(run)) {}

std::vector<TableFile> RunTables::files(const std::string& table) const {
  const std::size_t star = table.find('*');
  if (star == std::string::npos) {
    const bool there = std::find(names_.begin(), names_.end(), table) != names_.end();
    return there ? std::vector{TableFile{table, ""}} : std::vector<TableFile>();
  }
  const std::string begin = table.substr(0, star);
  const std::string end = table.substr(star + 1);
  std::vector<TableFile> found;
  for (const std::string& name : names_) {
    if (name.size() > begin.size() + end.size() && name.starts_with(begin) && name.ends_with(end)) {
      std::string label = name.substr(begin.size(), name.size() - begin.size() - end.size());
      if (is_label(label)) {
        found.push_back({name, std::move(label)});
      }
    }
  }
  std::sort(found.begin(), found.end(), [&](const TableFile& a, const TableFile& b) {
    return order(summary_, a.label) < order(summary_, b.label);
  });
  return found;
}

std::vector<TableFile> RunTables::files(const TableRequirement& need) {
  std::vector<TableFile> found = files(need.table);
  std::erase_if(found, [&](const TableFile& file) { return !satisfies(file.name, need); });
  return found;
}

const store::ReadTable& RunTables::read(const std::string& file) {
  const auto found = tables_.find(file);
  return found != tables_.end()
             ? found->second
             : tables_.emplace(file, store::read_table(run_ / file)).first->second;
}

bool RunTables::satisfies(const std::string& file, const TableRequirement& need) {
  const store::ReadTable& table = read(file);
  const auto has_changing = [&](const std::string& column) {
    const auto* cells = table.find(column);
    return cells != nullptr && std::any_of(cells->begin(), cells->end(), [&](const auto& cell) {
             return cell != cells->front();
           });
  };
  return std::all_of(need.columns.begin(), need.columns.end(),
                     [&](const std::string& column) {
                       const auto names = matching_columns(table, column, need);
                       for (const std::string& name : names) {
                         table.numbers(name);  // complains where gnuplot would leave out
                       }
                       return !names.empty();
                     }) &&
         std::all_of(need.changing.begin(), need.changing.end(), has_changing);
}

}  // namespace clca::plot
