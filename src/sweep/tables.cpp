// runs.csv and measures.csv.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "clca/record/quantity.hpp"
#include "clca/statistics/sample.hpp"
#include "clca/text/read.hpp"
#include "sweep/results.hpp"

namespace clca::sweep {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using StageMeasure = std::pair<std::string, std::string>;
using Measures = std::map<StageMeasure, store::MeasureValue>;

/// Yes is 1, no is 0; NaN where there is no number.
double number(const store::MeasureValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return std::isfinite(*number) ? *number : kNone;
  }
  const auto* answer = std::get_if<bool>(&value);
  return answer != nullptr ? static_cast<double>(*answer) : kNone;
}

/// The measures of each run, with the steps of each stage; empty for a run that is not done.
struct MeasuresByRun {
  explicit MeasuresByRun(std::span<const RunResult> results) : of_runs(results.size()) {
    std::set<StageMeasure> known;
    for (std::size_t run = 0; run < results.size(); ++run) {
      if (results[run].status != Status::done) {
        continue;
      }
      const auto add = [&](const StageMeasure& key, const store::MeasureValue& value) {
        of_runs[run][key] = value;
        if (known.insert(key).second) {
          keys.push_back(key);
        }
      };
      for (const store::StageSummary& stage : results[run].summary.stages) {
        add(StageMeasure(stage.name, "steps"), static_cast<double>(stage.steps));
        if (const auto& units = results[run].summary.units) {
          add(StageMeasure(stage.name, "time"), units->time(stage.steps));
        }
        for (const auto& [name, value] : stage.measures) {
          add(StageMeasure(stage.name, name), value);
        }
      }
    }
  }

  std::vector<StageMeasure> keys;  ///< in the order in which they first occur
  std::vector<Measures> of_runs;
};

const char* to_text(Status status) {
  constexpr std::array kNames = {"waiting", "done", "failed", "interrupted"};
  return kNames.at(static_cast<std::size_t>(status));
}

struct MeasureValues {
  std::vector<double> values;
  bool answers = false;  ///< of yes and no
};

/// Grains that left until the outlet clogged. A run that ended without a clog has seen a part of an
/// avalanche. Each grain that leaves clogs with one probability (Zuriguel et al. 2005, Phys. Rev. E
/// 71, 051303: avalanches have an exponential distribution), so the estimate of greatest likelihood
/// is all that left over the number of clogs, and its relative error is 1/sqrt(clogs).
void add_until_clog(store::Table& table, std::vector<store::Cell> row, const std::string& name,
                    const MeasureValues& clogged, const MeasureValues& discharged) {
  const double clogs = std::reduce(clogged.values.begin(), clogged.values.end());
  const double left = std::reduce(discharged.values.begin(), discharged.values.end());
  if (clogs > 0) {
    const double mean = left / clogs;
    const double error = mean / std::sqrt(clogs);
    row.insert(row.end(), {name, mean, kNone, error, static_cast<std::uint64_t>(clogs), kNone,
                           kNone, mean - error, mean + error});
    table.add_row(std::move(row));
  }
}

void add_statistics(store::Table& table, const std::vector<std::string>& values,
                    std::span<const RunResult> results) {
  const MeasuresByRun measures(results);
  std::map<StageMeasure, MeasureValues> columns;
  for (const Measures& of_run : measures.of_runs) {
    for (const auto& [key, value] : of_run) {
      MeasureValues& column = columns[key];
      column.values.push_back(number(value));
      column.answers = column.answers || std::holds_alternative<bool>(value);
    }
  }
  constexpr std::string_view kClogged = "clogged";
  for (const auto& [stage, measure] : measures.keys) {
    const MeasureValues& column = columns[{stage, measure}];
    const statistics::SampleStatistics found = statistics::sample_statistics(column.values);
    const auto [low, high] = column.answers ? statistics::wilson_interval(found.mean, found.count)
                                            : std::pair(found.mean - found.standard_error,
                                                        found.mean + found.standard_error);
    std::vector<store::Cell> beginning = value_cells(values);
    beginning.emplace_back(stage);
    std::vector<store::Cell> row = beginning;
    row.insert(row.end(), {measure, found.mean, found.standard_deviation, found.standard_error,
                           std::uint64_t{found.count}, found.least, found.most, low, high});
    table.add_row(std::move(row));
    if (measure.starts_with(kClogged)) {
      const std::string of = measure.substr(kClogged.size());
      if (const auto left = columns.find({stage, "discharged" + of}); left != columns.end()) {
        add_until_clog(table, std::move(beginning), "discharged_until_clog" + of, column,
                       left->second);
      }
    }
  }
}

}  // namespace

std::vector<store::Cell> value_cells(const std::vector<std::string>& values) {
  std::vector<store::Cell> cells;
  for (const std::string& value : values) {
    const bool is_formula = !text::number<double>(value) && value.find_first_of("=+-@") == 0;
    cells.emplace_back((is_formula ? "'" : "") + value);
  }
  return cells;
}

NamedTable runs_table(const Plan& plan, const std::vector<RunResult>& results) {
  const MeasuresByRun measures(results);
  std::vector<std::string> names;
  for (const auto& [stage, measure] : measures.keys) {
    names.push_back(fmt::format("{}.{}", stage, measure));
  }
  store::Table table(
      record::sweep_column_names("runs", {{"KEY", plan.varied_keys()}, {"STAGE.MEASURE", names}}));
  for (std::size_t run = 0; run < results.size(); ++run) {
    const auto& [status, summary, error] = results[run];
    const bool done = status == Status::done;
    std::vector<store::Cell> row = value_cells(plan.variant(run).values);
    row.insert(row.end(), {plan.seed(run), to_text(status),
                           done ? store::Cell(summary.steps) : store::Cell(kNone),
                           done ? fmt::format("{:016x}", summary.state_hash) : std::string()});
    const Measures& of_run = measures.of_runs[run];
    for (const StageMeasure& key : measures.keys) {
      const auto found = of_run.find(key);
      row.emplace_back(found != of_run.end() ? number(found->second) : kNone);
    }
    row.insert(row.end(), {"runs/" + plan.run_name(run), error});
    table.add_row(std::move(row));
  }
  return {"runs", std::move(table)};
}

NamedTable measures_table(const Plan& plan, const std::vector<RunResult>& results) {
  store::Table table(record::sweep_column_names("measures", {{"KEY", plan.varied_keys()}}));
  const std::size_t seeds = plan.request.seeds.size();
  for (std::size_t i = 0; i < plan.variants.size(); ++i) {
    add_statistics(table, plan.variants[i].values, std::span(results).subspan(i * seeds, seeds));
  }
  return {"measures", std::move(table)};
}

}  // namespace clca::sweep
