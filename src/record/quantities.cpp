#include "record/internal/quantities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "clca/scene/format.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/trajectory.hpp"
#include "clca/text/read.hpp"

namespace clca::record {

namespace {

/// Name and meaning, in a table in Markdown.
std::string described(const Quantity& quantity) {
  std::string text(quantity.name);
  if (!quantity.meaning.empty()) {
    text.append(": ").append(quantity.meaning);
  }
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
    text.insert(at, 1, '\\');
  }
  return text;
}

TableInfo sweep_table(std::string_view name, const std::vector<Quantity>& columns) {
  TableInfo table = {.name = name, .kind = TableInfo::Kind::whole};
  for (const Quantity& column : columns) {
    table.columns.push_back({column});
  }
  return table;
}

/// Measures that only a sweep has.
std::vector<Quantity> sweep_quantities() {
  return {{"steps", "Steps", "", "of the stage"},
          {"time", "Time", "time", "of the stage"},
          {"discharged_until_clog", "Discharged until a clog", "particles",
           "all that left in the runs, over the number of clogs"}};
}

/// Names in capitals stand for several columns.
std::vector<TableInfo> sweep_tables() {
  constexpr Quantity kVaried = {"KEY", "Value", "", "of each key that varies"};
  std::vector<TableInfo> all = {
      sweep_table(
          "runs",
          {kVaried,
           {"seed", "Seed", "", ""},
           {"status", "Status", "",
            "`done`, `failed`, `interrupted` or `waiting` (not begun); only runs that are done "
            "have numbers"},
           {"steps", "Steps", "", "of the whole run"},
           {"state_hash", "State hash", "", "of the final state"},
           {"STAGE.MEASURE", "Measure", "",
            "each of each stage; `STAGE.steps` and, with `model: contact`, `STAGE.time` are what "
            "the stage took"},
           {"folder", "Folder", "", "of the run"},
           {"error", "Error", "", "why the run failed"}}),
      sweep_table("measures",
                  {kVaried,
                   kStage,
                   {"measure", "Measure", "", "its name in run.json"},
                   {"mean", "Mean", "", "over the seeds; yes is 1, no is 0"},
                   {"standard_deviation", "Standard deviation", "", "of the sample, over n - 1"},
                   {"standard_error", "Standard error", "", "of the mean"},
                   {"runs", "Runs", "", "number of values"},
                   {"min", "Smallest value", "", ""},
                   {"max", "Largest value", "", ""},
                   {"low", "Lower end", "", "of the interval of one standard error"},
                   {"high", "Upper end", "", "of the same interval"}}),
      sweep_table("mean",
                  {kVaried,
                   {"ROW", "Row", "",
                    "what tells rows of the run apart, such as stage and step; steps and times "
                    "since the stage began"},
                   {"runs", "Runs", "", "number of values"},
                   {"COLUMN", "Mean", "of the column", "of each column, over the seeds"}})};
  all.back().columns.back().suffixes = {"", kErrorSuffix};
  return all;
}

/// What is declared of a kind of runs.
struct Declared {
  std::string prefix;  ///< of the names of its tables in columns_markdown(): `gas.`
  std::string of;      ///< follows the name of a file: ` of a gas`
  std::string where;   ///< where its measures are: `run.json of a gas`
  std::vector<Quantity> measures = {};
  std::vector<TableInfo> tables = {};
};

Declared declared_of_grains() {
  Declared all = {.prefix = "", .of = "", .where = "run.json, tables of a sweep"};
  for (const QuantityGroup& group : stage_quantities()) {
    all.measures.insert(all.measures.end(), group.quantities.begin(), group.quantities.end());
  }
  for (const ObserverFactory& kind : observer_factories()) {
    for (const auto& table : kind.tables) {
      all.tables.push_back(table({}));
    }
  }
  // The series first: a key that several tables have is explained as there.
  std::stable_partition(all.tables.begin(), all.tables.end(),
                        [](const TableInfo& table) { return table.name == "series"; });
  return all;
}

/// By KnownQuantities::Kind.
const std::array<Declared, 3>& all_declared() {
  static const std::array<Declared, 3> kAll = {
      {declared_of_grains(),
       {"gas.", " of a gas", "run.json of a gas", gas_quantities(), gas_tables()},
       {"sweep.", " of a sweep", "tables of a sweep", sweep_quantities(), sweep_tables()}}};
  return kAll;
}

const Declared& declared(KnownQuantities::Kind kind) {
  return all_declared().at(static_cast<std::size_t>(kind));
}

constexpr const char* kTrajectory = "trajectory";

/// x or y of a column of a vector; empty for others.
std::string_view part_of_vector(const Quantity& quantity, std::string_view column) {
  const std::string_view end = column.substr(std::min(quantity.key.size(), column.size()));
  const bool is_part = column.starts_with(quantity.key);
  return is_part && (end == "x" || end == "y") ? end : "";
}

store::ColumnSummary summary_of(std::string_view key, const Quantity& quantity,
                                const std::optional<scene::UnitConversion>& units) {
  const std::size_t dot = key.find('.');
  return {.key = std::string(key),
          .name = std::string(quantity.name),
          .part = std::string(dot == std::string_view::npos ? part_of_vector(quantity, key)
                                                            : key.substr(dot + 1)),
          .unit = shown_unit(quantity.unit, units),
          .meaning = std::string(quantity.meaning)};
}

/// `is_of_each`: KEY of a column KEY.NAME.
const Quantity* find_column(std::span<const TableInfo> tables, std::string_view name,
                            bool is_of_each = false) {
  for (const TableInfo& table : tables) {
    const auto found = std::ranges::find_if(table.columns, [&](const ColumnInfo& column) {
      return column.of_each.empty() != is_of_each &&
             std::ranges::count(column.column_names(), name) > 0;
    });
    if (found != table.columns.end()) {
      return &found->quantity;
    }
  }
  return nullptr;
}

const Quantity* find_in(std::span<const Quantity> quantities, std::string_view key) {
  const auto found = std::ranges::find_if(
      quantities, [&](const Quantity& quantity) { return quantity.key == key; });
  return found == quantities.end() ? nullptr : &*found;
}

}  // namespace

const Quantity* find_quantity(std::string_view key, KnownQuantities::Kind kind) {
  using Kind = KnownQuantities::Kind;
  const std::string_view whole = key.substr(0, key.find('.'));
  if (const Quantity* measure = find_in(declared(kind).measures, kind == Kind::gas ? key : whole)) {
    return measure;
  }
  if (kind == Kind::gas) {
    return nullptr;
  }
  if (kind == Kind::sweep) {
    const Quantity* of_runs = find_quantity(key);
    return of_runs != nullptr ? of_runs : find_column(declared(kind).tables, key);
  }
  const bool has_name = whole != key;  // KEY.NAME: those of each wall or outlet first
  for (const bool is_of_each : {has_name, !has_name}) {
    if (const Quantity* found = find_column(declared(kind).tables, whole, is_of_each)) {
      return found;
    }
  }
  return find_in(declared(Kind::sweep).measures, whole);
}

std::vector<NamedQuantity> named_quantities() {
  std::vector<NamedQuantity> all;
  for (const Declared& kind : all_declared()) {
    for (const Quantity& measure : kind.measures) {
      all.push_back({std::string(measure.key), &measure, kind.where, true});
    }
    for (const TableInfo& table : kind.tables) {
      const std::string file =
          store::table_name(table.name, table.kind == TableInfo::Kind::parts ? "STAGE" : "");
      for (const ColumnInfo& column : table.columns) {
        for (const std::string& key : column.column_names()) {
          all.push_back({key, &column.quantity, file + kind.of, !column.of_each.empty()});
        }
      }
    }
  }
  return all;
}

std::optional<store::ColumnSummary> KnownQuantities::find(std::string_view key) const {
  const auto own = std::ranges::find(derived_measures, key, &scene::DerivedMeasure::name);
  if (own != derived_measures.end()) {
    return store::ColumnSummary{.key = own->name,
                                .name = own->about.value_or(own->name),
                                .unit = own->unit == "1" ? "" : shown_unit(own->unit, units),
                                .meaning = own->expression};
  }
  const Quantity* known = find_quantity(key, kind);
  if (known == nullptr) {
    return std::nullopt;
  }
  store::ColumnSummary summary = summary_of(key, *known, units);
  summary.relative_to_floor = known->is_relative_to_floor;
  return summary;
}

KnownQuantities known_quantities(const store::RunSummary& summary) {
  using Kind = KnownQuantities::Kind;
  return {.kind = summary.kind == "boltzmann" ? Kind::gas
                  : summary.kind == "sweep"   ? Kind::sweep
                                              : Kind::run,
          .units = summary.units,
          .derived_measures = summary.derived_measures};
}

std::vector<store::ColumnSummary> sweep_column_summaries(
    std::string_view table, const std::vector<std::string>& columns,
    const std::vector<KnownQuantities>& known) {
  const bool is_of_means = table.starts_with("mean-");
  const std::vector<TableInfo>& tables = declared(KnownQuantities::Kind::sweep).tables;
  const auto info =
      std::ranges::find(tables, is_of_means ? std::string_view("mean") : table, &TableInfo::name);
  std::vector<store::ColumnSummary> result;
  for (const std::string& key : columns) {
    const std::size_t ending = key.ends_with(kErrorSuffix) ? kErrorSuffix.size() : 0;
    const std::string of = key.substr(0, key.size() - ending);
    const Quantity* own = info != tables.end() ? find_column({&*info, 1}, key) : nullptr;
    const auto column = [&](const KnownQuantities& of_runs) {
      auto found = own != nullptr ? std::optional(summary_of(key, *own, of_runs.units))
                                  : of_runs.find(of.substr(of.find('.') + 1));
      found = found ? found : of_runs.find(of);
      return found.value_or(store::ColumnSummary{.key = key, .name = key});
    };
    result.push_back(column(known.front()));
    for (const KnownQuantities& others : known) {
      const std::string unit = column(others).unit;
      // Runs without units have velocities, but no times and masses.
      const bool is_there = others.units || unit.find("spacings/step") != std::string::npos;
      if (is_there && unit != result.back().unit) {
        result.back().unit = "units differ";
      }
    }
    result.back().key = key;
    if (is_of_means && (key == kStep.key || key == "time")) {
      result.back().meaning = "since the stage began";
    }
  }
  return result;
}

std::vector<std::string> sweep_measure_names() {
  std::vector<std::string> keys;
  for (const Quantity& quantity : declared(KnownQuantities::Kind::sweep).measures) {
    keys.emplace_back(quantity.key);
  }
  return keys;
}

std::vector<std::string> sweep_column_names(
    std::string_view table, const std::map<std::string_view, std::vector<std::string>>& names) {
  const std::vector<TableInfo>& tables = declared(KnownQuantities::Kind::sweep).tables;
  std::vector<std::string> columns;
  for (const ColumnInfo& column : std::ranges::find(tables, table, &TableInfo::name)->columns) {
    const auto several = names.find(column.quantity.key);
    for (const std::string& key :
         several != names.end() ? several->second : std::vector{std::string(column.quantity.key)}) {
      for (const std::string_view ending : column.suffixes) {
        columns.push_back(key + std::string(ending));
      }
    }
  }
  return columns;
}

std::vector<store::ColumnSummary> RunTable::column_descriptions() const {
  std::vector<store::ColumnSummary> result;
  for (const std::string& name : table_.column_names()) {
    const Quantity* column = find_column({&info_, 1}, name);
    const Quantity* known =
        column != nullptr ? column : find_column({&info_, 1}, name.substr(0, name.find('.')), true);
    result.push_back(known != nullptr ? summary_of(name, *known, conversion_)
                                      : store::ColumnSummary{.key = name, .name = name});
  }
  return result;
}

std::string shown_unit(std::string_view unit, const std::optional<scene::UnitConversion>& units) {
  if (const auto si = units ? units->si_unit(unit) : std::nullopt) {
    return std::string(si->name);
  }
  std::string text(unit);
  const auto replace = [&text](std::string_view word, const std::string& with) {
    const std::size_t position = text.find(word);
    if (position != std::string::npos) {
      text.replace(position, word.size(), with);
    }
  };
  if (units) {
    replace("spacings/step", units->velocity_unit);
    replace("time", units->time_unit);
  }
  return text;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names = {kTrajectory};
  for (const Declared& kind : all_declared()) {
    for (const TableInfo& table : kind.tables) {
      names.push_back(kind.prefix + std::string(table.name));
    }
  }
  return names;
}

std::string columns_markdown(std::string_view table) {
  if (table == kTrajectory) {
    return store::datasets_markdown_table();
  }
  const TableInfo* found = nullptr;
  for (const Declared& kind : all_declared()) {
    for (const TableInfo& known : kind.tables) {
      found = table == kind.prefix + std::string(known.name) ? &known : found;
    }
  }
  if (found == nullptr) {
    throw text::InputError(
        fmt::format("no table '{}'; there are {}", table, fmt::join(table_names(), ", ")));
  }
  std::string text = "| column | unit | what |\n|---|---|---|\n";
  for (const ColumnInfo& column : found->columns) {
    const Quantity& what = column.quantity;
    const std::string names = !column.of_each.empty()
                                  ? fmt::format("`{}.{}`", what.key, column.of_each)
                              : column.suffixes.back() == kErrorSuffix
                                  ? fmt::format("`{}` (`_se`)", what.key)
                                  : fmt::format("`{}`", fmt::join(column.column_names(), "`, `"));
    text += fmt::format("| {} | {} | {}{}{} |\n", names, what.unit, described(what),
                        column.condition.empty() ? "" : "; ", column.condition);
  }
  return text;
}

std::string quantities_markdown() {
  std::string table = "| measure | in run.json | unit | what |\n|---|---|---|---|\n";
  std::optional<scene::Measure> above;
  for (const QuantityGroup& group : stage_quantities()) {
    const bool is_new = group.measure && group.measure != above;
    std::string first = is_new ? fmt::format("`{}`", scene::name_of_measure(*group.measure)) : "";
    if (!group.condition.empty()) {
      first += fmt::format("{}({})", is_new ? " " : "", group.condition);
    }
    above = group.measure;
    for (const Quantity& quantity : group.quantities) {
      table += fmt::format("| {} | `{}` | {} | {} |\n", std::exchange(first, ""), quantity.key,
                           quantity.unit.empty() ? "1" : quantity.unit, described(quantity));
    }
  }
  return table;
}

}  // namespace clca::record
