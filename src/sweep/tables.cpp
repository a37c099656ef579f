#include "sweep/tables.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string_view>
#include <utility>

#include "clca/record/quantity.hpp"
#include "clca/statistics/sample.hpp"
#include "clca/store/table.hpp"

namespace clca::sweep {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Stage and name of a measure.
using Key = std::pair<std::string, std::string>;

/// Yes is 1, no is 0; NaN where there is no number.
double number(const store::MeasureValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return std::isfinite(*number) ? *number : kNone;
  }
  const auto* answer = std::get_if<bool>(&value);
  return answer != nullptr ? static_cast<double>(*answer) : kNone;
}

/// Calls `use(key, value)` for each measure of a run, the number of steps of a stage among them.
template <class Use>
void for_each_measure(const Result& result, Use use) {
  for (const store::StageSummary& stage : result.summary.stages) {
    use(Key(stage.name, "steps"), store::MeasureValue(static_cast<double>(stage.steps)));
    if (const auto& units = result.summary.units) {
      use(Key(stage.name, "time"), store::MeasureValue(units->time(stage.steps)));
    }
    for (const auto& [name, value] : stage.measures) {
      use(Key(stage.name, name), value);
    }
  }
}

/// The measures that occur in runs [first, last), in the order in which they first do.
class Measures {
 public:
  Measures(const std::vector<Result>& results, std::size_t first, std::size_t last) {
    for (std::size_t run = first; run < last; ++run) {
      if (results[run].status == Status::done) {
        for_each_measure(results[run], [this](const Key& key, const auto& /*value*/) { add(key); });
      }
    }
  }
  const std::vector<Key>& keys() const { return keys_; }
  std::size_t position(const Key& key) const { return positions_.at(key); }
  /// Null if there is no such measure.
  const std::size_t* find(const Key& key) const {
    const auto at = positions_.find(key);
    return at == positions_.end() ? nullptr : &at->second;
  }

 private:
  void add(const Key& key) {
    if (positions_.emplace(key, keys_.size()).second) {
      keys_.push_back(key);
    }
  }

  std::vector<Key> keys_;
  std::map<Key, std::size_t> positions_;
};

std::string to_text(Status status) {
  switch (status) {
    case Status::done:
      return "done";
    case Status::failed:
      return "failed";
    case Status::interrupted:
      return "interrupted";
    case Status::waiting:
      break;
  }
  return "waiting";
}

std::vector<store::Cell> run_row(const Plan& plan, std::size_t run, const Result& result,
                                 const Measures& measures) {
  std::vector<store::Cell> row = value_cells(plan.variant(run).values);
  const bool done = result.status == Status::done;
  row.insert(row.end(), {plan.seed(run), to_text(result.status),
                         done ? store::Cell(result.summary.steps) : store::Cell(kNone),
                         done ? fmt::format("{:016x}", result.summary.state_hash) : std::string()});
  const std::size_t first = row.size();
  row.resize(first + measures.keys().size(), kNone);
  if (done) {
    for_each_measure(result, [&](const Key& key, const store::MeasureValue& value) {
      row[first + measures.position(key)] = number(value);
    });
  }
  row.insert(row.end(), {"runs/" + plan.name(run), result.error});
  return row;
}

/// A measure over the completed runs of a combination.
struct Column {
  std::vector<double> values;
  bool answers = false;  ///< of yes and no
};

/// Grains that left until the outlet clogged. A run that ended without a clog has seen a part of an
/// avalanche. Each grain that leaves clogs with one probability (Zuriguel et al. 2005, Phys. Rev. E
/// 71, 051303: avalanches have an exponential distribution), so the estimate of greatest likelihood
/// is all that left over the number of clogs, and its relative error is 1/sqrt(clogs).
void add_until_clog(store::Table& table, std::vector<store::Cell> row, const std::string& name,
                    const Column& clogged, const Column& discharged) {
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
                    const std::vector<Result>& results, std::size_t first, std::size_t last) {
  const Measures measures(results, first, last);
  std::vector<Column> columns(measures.keys().size());
  for (std::size_t run = first; run < last; ++run) {
    if (results[run].status == Status::done) {
      for_each_measure(results[run], [&](const Key& key, const store::MeasureValue& value) {
        Column& column = columns[measures.position(key)];
        column.values.push_back(number(value));
        column.answers = column.answers || std::holds_alternative<bool>(value);
      });
    }
  }
  constexpr std::string_view kClogged = "clogged";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto& [stage, measure] = measures.keys()[i];
    const statistics::Sample found = statistics::sample(columns[i].values);
    const auto [low, high] =
        columns[i].answers
            ? statistics::share_interval(found.mean, found.count)
            : std::pair(found.mean - found.standard_error, found.mean + found.standard_error);
    std::vector<store::Cell> beginning = value_cells(values);
    beginning.emplace_back(stage);
    std::vector<store::Cell> row = beginning;
    row.insert(row.end(), {measure, found.mean, found.standard_deviation, found.standard_error,
                           std::uint64_t{found.count}, found.least, found.most, low, high});
    table.add_row(std::move(row));
    if (measure.starts_with(kClogged)) {
      const std::string of = measure.substr(kClogged.size());
      if (const auto* discharged = measures.find({stage, "discharged" + of})) {
        add_until_clog(table, std::move(beginning), "discharged_until_clog" + of, columns[i],
                       columns[*discharged]);
      }
    }
  }
}

}  // namespace

std::vector<store::Cell> value_cells(const std::vector<std::string>& values) {
  std::vector<store::Cell> cells;
  for (const std::string& value : values) {
    double number = 0;
    const char* end = value.data() + value.size();
    const bool is_number = std::from_chars(value.data(), end, number).ptr == end;
    const bool is_formula = !is_number && value.find_first_of("=+-@") == 0;
    cells.emplace_back((is_formula ? "'" : "") + value);
  }
  return cells;
}

NamedTable runs_table(const Plan& plan, const std::vector<Result>& results) {
  const Measures measures(results, 0, results.size());
  std::vector<std::string> names;
  for (const auto& [stage, measure] : measures.keys()) {
    names.push_back(fmt::format("{}.{}", stage, measure));
  }
  store::Table table(
      record::sweep_columns("runs", {{"KEY", plan.keys()}, {"STAGE.MEASURE", names}}));
  for (std::size_t run = 0; run < results.size(); ++run) {
    table.add_row(run_row(plan, run, results[run], measures));
  }
  return {"runs", std::move(table)};
}

NamedTable measures_table(const Plan& plan, const std::vector<Result>& results) {
  store::Table table(record::sweep_columns("measures", {{"KEY", plan.keys()}}));
  const std::size_t seeds = plan.request.seeds.size();
  for (std::size_t i = 0; i < plan.variants.size(); ++i) {
    add_statistics(table, plan.variants[i].values, results, i * seeds, (i + 1) * seeds);
  }
  return {"measures", std::move(table)};
}

}  // namespace clca::sweep
