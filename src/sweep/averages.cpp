#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "clca/record/quantity.hpp"
#include "clca/statistics/sample.hpp"
#include "clca/store/file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/table.hpp"
#include "sweep/results.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr double kNoMean = std::numeric_limits<double>::quiet_NaN();

/// A table of runs that is averaged. Rows are the same where groups and positions are.
struct AveragedTable {
  std::string begin;  ///< of the file name: the table, or what comes before a stage
  Names groups;       ///< columns of names
  Names positions;    ///< columns of numbers
  Names others = {};  ///< columns that are left out

  bool is_by_step() const { return positions.front() == "step"; }
};

const std::vector<AveragedTable>& averaged_tables() {
  static const std::vector<AveragedTable> kAll = {
      {"series", {"stage"}, {"step"}, {"time"}},
      {"probes", {"stage", "probe"}, {"step"}, {"time"}},
      {"cycles", {"stage"}, {"cycle"}, {"step", "time"}},
      {"profile-", {}, {"x"}},
      {"lines-", {"line"}, {"position", "x", "y"}},
      {"weight_paths-", {}, {"base_position"}, {"x"}}};
  return kAll;
}

bool has_name(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

using Position = std::vector<double>;

/// The rows of one group in the table, by position. Of steps: those since the stage began.
using Curve = std::map<Position, std::size_t>;

struct RunCurves {
  std::map<std::string, std::vector<double>> columns = {};  ///< with means
  std::vector<Names> groups = {};                           ///< in their order
  std::map<Names, Curve> curves = {};
};

/// Steps of the whole run before a stage.
std::map<std::string, std::uint64_t> stage_starts(const store::RunSummary& summary) {
  std::map<std::string, std::uint64_t> starts;
  std::uint64_t step = summary.steps;
  for (const store::StageSummary& stage : summary.stages) {
    step -= stage.steps;
  }
  for (const store::StageSummary& stage : summary.stages) {
    starts[stage.name] = step;
    step += stage.steps;
  }
  return starts;
}

/// Adds the names of the columns with means to `columns`. Throws store::StoreError.
RunCurves read_curves(const AveragedTable& what, const fs::path& file,
                      const store::RunSummary& summary, Names& columns) {
  const store::ParsedTable table = store::read_table(file);
  RunCurves result;
  for (const std::string& name : table.column_names) {
    if (!has_name(what.groups, name) && !has_name(what.positions, name) &&
        !has_name(what.others, name) && !name.ends_with(record::kErrorSuffix)) {
      result.columns[name] = table.column_numbers(name);
    }
  }
  std::vector<std::vector<double>> at;
  std::ranges::transform(what.positions, std::back_inserter(at),
                         [&](const std::string& name) { return table.column_numbers(name); });
  const auto starts = stage_starts(summary);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    Names group;
    for (const std::string& name : what.groups) {
      const std::vector<std::string>* cells = table.find_column(name);
      group.push_back(cells != nullptr ? (*cells)[row] : "");
    }
    Position position;
    for (const std::vector<double>& numbers : at) {
      position.push_back(numbers[row]);
    }
    if (const auto start = what.is_by_step() ? starts.find(group.front()) : starts.end();
        start != starts.end()) {
      position.front() -= static_cast<double>(start->second);
    }
    Curve& curve = result.curves[group];
    const bool is_first = curve.empty();
    const bool is_known = std::ranges::all_of(position, [](double x) { return std::isfinite(x); });
    if (!is_known || !(is_first || curve.rbegin()->first < position)) {
      throw store::StoreError(fmt::format("cannot read {}: line {}: not behind the one before",
                                          file.string(), row + 2));
    }
    if (is_first) {
      result.groups.push_back(group);
    }
    curve.emplace_hint(curve.end(), std::move(position), row);
  }
  for (const std::string& name : table.column_names) {
    if (result.columns.contains(name) && !has_name(columns, name)) {
      columns.push_back(name);
    }
  }
  return result;
}

/// The value of a column at a position; of steps between two rows by a straight line.
double value_at(const std::vector<double>& column, const Curve& curve, const Position& position) {
  const auto after = curve.lower_bound(position);
  const double value = column[after->second];
  if (after->first == position) {
    return value;
  }
  const auto before = std::prev(after);
  const double start = before->first.front();
  const double share = (position.front() - start) / (after->first.front() - start);
  const double value_before = column[before->second];
  return value_before + share * (value - value_before);
}

/// The steps since the stage began that all of the curves reach, at the interval of the series.
std::vector<Position> common_steps(const std::vector<const Curve*>& curves, double every) {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  for (const Curve* curve : curves) {
    from = std::max(from, curve->begin()->first.front());
    to = std::min(to, curve->rbegin()->first.front());
  }
  std::vector<Position> steps;
  for (double row = std::ceil(from / every); row * every <= to; ++row) {
    steps.push_back({row * every});
  }
  return steps;
}

std::vector<Position> common_positions(const std::vector<const Curve*>& curves) {
  std::vector<Position> common;
  for (const auto& row : *curves.front()) {
    if (std::ranges::all_of(curves, [&](auto* curve) { return curve->contains(row.first); })) {
      common.push_back(row.first);
    }
  }
  return common;
}

struct MeanRow {
  std::vector<store::Cell> place;  ///< varied values, group and position
  double time;  ///< of the step; NaN without units, and in tables that are not by step
  std::uint64_t runs;
  std::vector<double> means;  ///< of each column the mean and its standard error
};

struct Means {
  Names columns = {};
  bool has_time = false;
  std::vector<MeanRow> rows = {};
};

void add_rows(Means& means, const AveragedTable& what, const Variant& variant,
              const scene::UnitConversion* units, const std::vector<RunCurves>& runs,
              const Names& group) {
  std::vector<const Curve*> curves;
  for (const RunCurves& run : runs) {
    const auto curve = run.curves.find(group);
    if (curve == run.curves.end()) {
      return;  // not all runs have come so far
    }
    curves.push_back(&curve->second);
  }
  const auto& series = variant.scene.output.series;
  const auto every = static_cast<double>(series ? series->every : 1);
  for (const auto& position :
       what.is_by_step() ? common_steps(curves, every) : common_positions(curves)) {
    const bool has_time = what.is_by_step() && units != nullptr;
    MeanRow& row = means.rows.emplace_back(
        MeanRow{value_cells(variant.values),
                has_time ? units->time(static_cast<std::uint64_t>(position.front())) : kNoMean,
                curves.size(),
                {}});
    row.place.insert(row.place.end(), group.begin(), group.end());
    row.place.insert(row.place.end(), position.begin(), position.end());
    for (const std::string& column : means.columns) {
      std::vector<double> values;
      for (std::size_t run = 0; run < curves.size(); ++run) {
        const auto numbers = runs[run].columns.find(column);
        values.push_back(numbers == runs[run].columns.end()
                             ? kNoMean
                             : value_at(numbers->second, *curves[run], position));
      }
      const statistics::SampleStatistics found = statistics::sample_statistics(values);
      const bool is_known = found.count == values.size();  // all runs have a number
      row.means.insert(row.means.end(), {is_known ? found.mean : kNoMean,
                                         is_known ? found.standard_error : kNoMean});
    }
  }
}

/// The table; none if a varied number has the name of a column, or there is nothing.
std::optional<store::Table> mean_table(const AveragedTable& what, const Names& keys, Means means) {
  const bool has_time = what.is_by_step() && means.has_time;
  Names position = what.groups;
  position.insert(position.end(), what.positions.begin(), what.positions.end());
  if (has_time) {
    position.emplace_back("time");
  }
  const Names heads = record::sweep_column_names(
      "mean", {{"KEY", keys}, {"ROW", position}, {"COLUMN", means.columns}});
  if (means.columns.empty() || std::set(heads.begin(), heads.end()).size() < heads.size()) {
    return std::nullopt;
  }
  store::Table table(heads);
  for (MeanRow& row : means.rows) {
    std::vector<store::Cell> cells = std::move(row.place);
    if (has_time) {
      cells.emplace_back(row.time);
    }
    cells.emplace_back(row.runs);
    row.means.resize(2 * means.columns.size(),
                     kNoMean);  // some columns only later combinations have
    cells.insert(cells.end(), row.means.begin(), row.means.end());
    table.add_row(std::move(cells));
  }
  return table;
}

/// `series`, or `profile-flow` for each stage of some run.
std::set<std::string> tables_of(const AveragedTable& what, const std::vector<RunResult>& results) {
  if (!what.begin.ends_with('-')) {
    return {what.begin};
  }
  std::set<std::string> names;
  for (const RunResult& result : results) {
    for (const store::StageSummary& stage : result.summary.stages) {
      names.insert(what.begin + stage.name);
    }
  }
  return names;
}

}  // namespace

std::vector<NamedTable> mean_tables(
    const Plan& plan, const std::vector<RunResult>& results,
    const std::function<std::filesystem::path(std::size_t run)>& folder_of,
    const std::function<void(const std::string& line)>& warning) {
  std::vector<NamedTable> tables;
  const std::size_t seeds = plan.request.seeds.size();
  const auto add_means = [&](Means& means, const AveragedTable& what, const std::string& file,
                             std::size_t variant) {
    std::vector<RunCurves> runs;
    const scene::UnitConversion* units = nullptr;
    for (std::size_t run = variant * seeds; run < (variant + 1) * seeds; ++run) {
      const fs::path path = folder_of(run) / store::table_name(file);
      std::error_code error;
      if (results[run].status != Status::done || !fs::exists(path, error)) {
        continue;
      }
      try {
        runs.push_back(read_curves(what, path, results[run].summary, means.columns));
        const auto& of_run = results[run].summary.units;
        units = of_run ? &*of_run : nullptr;
      } catch (const store::StoreError& unreadable) {
        warning(unreadable.what());
      }
    }
    means.has_time = means.has_time || units != nullptr;
    if (!runs.empty()) {
      for (const Names& group : runs.front().groups) {
        add_rows(means, what, plan.variants[variant], units, runs, group);
      }
    }
  };
  for (const AveragedTable& what : averaged_tables()) {
    for (const std::string& file : tables_of(what, results)) {
      Means means;
      for (std::size_t variant = 0; variant < plan.variants.size(); ++variant) {
        add_means(means, what, file, variant);
      }
      if (auto table = mean_table(what, plan.varied_keys(), std::move(means))) {
        tables.push_back({"mean-" + file, *std::move(table)});
      }
    }
  }
  return tables;
}

}  // namespace clca::sweep
