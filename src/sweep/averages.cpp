
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
#include "sweep/tables.hpp"

namespace clca::sweep {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

constexpr double kNoMean = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kErrorEnding = "_se";

/// A table of runs that is averaged. Rows are the same where groups and positions are.
struct Averaged {
  std::string begin;  ///< of the file name: the table, or what comes before a stage
  Names groups;       ///< columns of names
  Names positions;    ///< columns of numbers; none: steps
  Names others = {};  ///< columns that are left out
};

const std::vector<Averaged>& averaged_tables() {
  static const std::vector<Averaged> kAll = {{"series", {"stage"}, {}},
                                             {"probes", {"stage", "probe"}, {}},
                                             {"cycles", {"stage"}, {"cycle"}, {"step", "time"}},
                                             {"profile-", {}, {"x"}},
                                             {"lines-", {"line"}, {"position", "x", "y"}},
                                             {"weight_paths-", {}, {"base_position"}, {"x"}}};
  return kAll;
}

bool has_name(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// The rows of one group, by position. Of steps: those since the stage began.
struct Curve {
  std::vector<std::vector<double>> positions;  ///< by row
  std::vector<std::vector<double>> values;     ///< by column, then row
};

/// A table of one run.
struct ReadCurves {
  Names columns = {};  ///< with means
  std::vector<std::pair<Names, Curve>> curves = {};

  const Curve* find(const Names& group) const {
    const auto found = std::ranges::find(curves, group, &std::pair<Names, Curve>::first);
    return found == curves.end() ? nullptr : &found->second;
  }
  /// A new one, with so many columns, if there is none.
  Curve& of(const Names& group, std::size_t width) {
    const auto found = std::ranges::find(curves, group, &std::pair<Names, Curve>::first);
    return found != curves.end()
               ? found->second
               : curves.emplace_back(group, Curve{{}, std::vector<std::vector<double>>(width)})
                     .second;
  }
  /// The values of a column of a curve; null if the run has none.
  const std::vector<double>* values(const Curve& curve, const std::string& column) const {
    const auto found = std::ranges::find(columns, column);
    return found == columns.end()
               ? nullptr
               : &curve.values[static_cast<std::size_t>(found - columns.begin())];
  }
};

/// Steps of the whole run before a stage.
std::map<std::string, double> stage_starts(const store::RunSummary& summary) {
  std::map<std::string, double> starts;
  auto step = static_cast<double>(summary.steps);
  for (const auto& stage : summary.stages) {
    step -= static_cast<double>(stage.steps);
  }
  for (const auto& stage : summary.stages) {
    starts[stage.name] = step;
    step += static_cast<double>(stage.steps);
  }
  return starts;
}

/// Throws store::StoreError.
ReadCurves read_curves(const Averaged& what, const fs::path& file,
                       const store::RunSummary& summary) {
  const store::ReadTable table = store::read_table(file);
  const bool by_step = what.positions.empty();
  const Names positions = by_step ? Names{"step"} : what.positions;
  ReadCurves result;
  std::vector<std::vector<double>> values;
  for (const std::string& name : table.names) {
    const bool is_time = by_step && name == "time";
    if (has_name(what.groups, name) || has_name(positions, name) || has_name(what.others, name) ||
        is_time || name.ends_with(kErrorEnding)) {
      continue;
    }
    result.columns.push_back(name);
    values.push_back(table.numbers(name));
  }
  std::vector<std::vector<double>> at;
  std::ranges::transform(positions, std::back_inserter(at),
                         [&](const std::string& name) { return table.numbers(name); });
  const std::map<std::string, double> starts = stage_starts(summary);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Names group;
    for (const std::string& name : what.groups) {
      const std::vector<std::string>* cells = table.find(name);
      group.push_back(cells != nullptr ? (*cells)[row] : "");
    }
    Curve& curve = result.of(group, values.size());
    std::vector<double> position;
    for (const std::vector<double>& numbers : at) {
      const auto start = by_step ? starts.find(group.front()) : starts.end();
      position.push_back(numbers[row] - (start == starts.end() ? 0 : start->second));
    }
    const bool is_behind = curve.positions.empty() || curve.positions.back() < position;
    if (!is_behind || !std::isfinite(position.front())) {
      throw store::StoreError(fmt::format("cannot read {}: line {}: not behind the one before",
                                          file.string(), row + 2));
    }
    curve.positions.push_back(std::move(position));
    for (std::size_t column = 0; column < values.size(); ++column) {
      curve.values[column].push_back(values[column][row]);
    }
  }
  return result;
}

/// The value at a position; of steps between two rows by a straight line.
double value_at(const Curve& curve, const std::vector<double>& values,
                const std::vector<double>& position) {
  const auto after = std::ranges::lower_bound(curve.positions, position);
  const auto row = static_cast<std::size_t>(after - curve.positions.begin());
  if (*after == position) {
    return values[row];
  }
  const double before = curve.positions[row - 1].front();
  const double share = (position.front() - before) / (after->front() - before);
  return values[row - 1] + share * (values[row] - values[row - 1]);
}

/// The steps since the stage began that all of the curves reach, at the interval of the series.
std::vector<std::vector<double>> common_steps(const std::vector<const Curve*>& curves,
                                              double every) {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  for (const Curve* curve : curves) {
    from = std::max(from, curve->positions.front().front());
    to = std::min(to, curve->positions.back().front());
  }
  std::vector<std::vector<double>> steps;
  const auto first = static_cast<std::uint64_t>(std::ceil(from / every));
  for (std::uint64_t row = first; static_cast<double>(row) * every <= to; ++row) {
    steps.push_back({static_cast<double>(row) * every});
  }
  return steps;
}

/// The positions that all of the curves have.
std::vector<std::vector<double>> common_positions(const std::vector<const Curve*>& curves) {
  std::vector<std::vector<double>> positions = curves.front()->positions;
  for (const Curve* curve : curves) {
    const std::set<std::vector<double>> known(curve->positions.begin(), curve->positions.end());
    std::erase_if(positions,
                  [&](const std::vector<double>& position) { return !known.contains(position); });
  }
  return positions;
}

struct MeanRow {
  Names group;
  std::vector<double> position;
  std::uint64_t runs;
  std::vector<std::pair<double, double>> means;  ///< by column, with its standard error
};

/// Of one combination.
struct Means {
  const Variant* variant = nullptr;
  std::optional<scene::Conversion> units = {};
  Names columns = {};
  std::vector<MeanRow> rows = {};
};

/// Over the finite values of all runs; none if one has none.
std::pair<double, double> mean_of(const std::vector<double>& values) {
  const statistics::Sample found = statistics::sample(values);
  return found.count == values.size() ? std::pair(found.mean, found.standard_error)
                                      : std::pair(kNoMean, kNoMean);
}

void add_rows(Means& means, const Averaged& what, const std::vector<ReadCurves>& runs,
              const Names& group) {
  std::vector<const Curve*> curves;
  for (const ReadCurves& run : runs) {
    curves.push_back(run.find(group));
  }
  if (std::ranges::count(curves, nullptr) > 0) {
    return;  // not all runs have come so far
  }
  const auto& series = means.variant->scene.output.series;
  const auto every = static_cast<double>(series ? series->every : 1);
  for (const auto& position :
       what.positions.empty() ? common_steps(curves, every) : common_positions(curves)) {
    MeanRow row = {.group = group, .position = position, .runs = curves.size(), .means = {}};
    for (const std::string& column : means.columns) {
      std::vector<double> values;
      for (std::size_t run = 0; run < curves.size(); ++run) {
        const std::vector<double>* all = runs[run].values(*curves[run], column);
        values.push_back(all != nullptr ? value_at(*curves[run], *all, position) : kNoMean);
      }
      row.means.push_back(mean_of(values));
    }
    means.rows.push_back(std::move(row));
  }
}

void add_new(Names& names, const Names& more) {
  std::ranges::copy_if(more, std::back_inserter(names),
                       [&names](const std::string& name) { return !has_name(names, name); });
}

/// The table; none if a varied number has the name of a column, or there is nothing.
std::optional<store::Table> mean_table(const Averaged& what, const Names& keys,
                                       const std::vector<Means>& all) {
  const bool has_time = what.positions.empty() && std::ranges::any_of(all, [](const Means& means) {
                          return means.units.has_value();
                        });
  Names columns;
  std::ranges::for_each(all, [&](const Means& means) { add_new(columns, means.columns); });
  Names position = what.groups;
  const Names times = has_time ? Names{"step", "time"} : Names{"step"};
  const Names& positions = what.positions.empty() ? times : what.positions;
  position.insert(position.end(), positions.begin(), positions.end());
  const Names heads =
      record::sweep_columns("mean", {{"KEY", keys}, {"ROW", position}, {"COLUMN", columns}});
  if (columns.empty() || std::set(heads.begin(), heads.end()).size() < heads.size()) {
    return std::nullopt;
  }
  store::Table table(heads);
  for (const Means& means : all) {
    for (const MeanRow& row : means.rows) {
      std::vector<store::Cell> cells = value_cells(means.variant->values);
      cells.insert(cells.end(), row.group.begin(), row.group.end());
      cells.insert(cells.end(), row.position.begin(), row.position.end());
      if (has_time) {
        const auto step = static_cast<std::uint64_t>(row.position.front());
        cells.emplace_back(means.units ? means.units->time(step) : kNoMean);
      }
      cells.emplace_back(row.runs);
      for (const std::string& column : columns) {
        const auto at = std::ranges::find(means.columns, column) - means.columns.begin();
        const bool is_there = static_cast<std::size_t>(at) < means.columns.size();
        const auto [mean, error] =
            is_there ? row.means[static_cast<std::size_t>(at)] : std::pair(kNoMean, kNoMean);
        cells.insert(cells.end(), {mean, error});
      }
      table.add_row(std::move(cells));
    }
  }
  return table;
}

/// `series`, or `profile-flow` for each stage of some run.
std::set<std::string> tables_of(const Averaged& what, const std::vector<Result>& results) {
  if (!what.begin.ends_with('-')) {
    return {what.begin};
  }
  std::set<std::string> names;
  for (const Result& result : results) {
    for (const store::StageSummary& stage : result.summary.stages) {
      names.insert(what.begin + stage.name);
    }
  }
  return names;
}

}  // namespace

std::vector<NamedTable> mean_tables(
    const Plan& plan, const std::vector<Result>& results,
    const std::function<std::filesystem::path(std::size_t run)>& folder_of,
    const std::function<void(const std::string& line)>& warning) {
  std::vector<NamedTable> tables;
  const std::size_t seeds = plan.request.seeds.size();
  const auto means_of = [&](const Averaged& what, const std::string& file, std::size_t variant) {
    Means means = {.variant = &plan.variants[variant]};
    std::vector<ReadCurves> runs;
    for (std::size_t run = variant * seeds; run < (variant + 1) * seeds; ++run) {
      const fs::path path = folder_of(run) / store::table_name(file);
      std::error_code error;
      if (results[run].status != Status::done || !fs::exists(path, error)) {
        continue;
      }
      try {
        runs.push_back(read_curves(what, path, results[run].summary));
        add_new(means.columns, runs.back().columns);
        means.units = results[run].summary.units;
      } catch (const store::StoreError& unreadable) {
        warning(unreadable.what());
      }
    }
    if (!runs.empty()) {
      for (const auto& [group, curve] : runs.front().curves) {
        add_rows(means, what, runs, group);
      }
    }
    return means;
  };
  for (const Averaged& what : averaged_tables()) {
    for (const std::string& file : tables_of(what, results)) {
      std::vector<Means> all;
      for (std::size_t variant = 0; variant < plan.variants.size(); ++variant) {
        all.push_back(means_of(what, file, variant));
      }
      if (auto table = mean_table(what, plan.keys(), all)) {
        tables.push_back({"mean-" + file, *std::move(table)});
      }
    }
  }
  return tables;
}

}  // namespace clca::sweep
