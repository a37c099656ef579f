#include "record/internal/quantities.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

/// The series first: a key that several tables have is explained as there.
const std::vector<TableInfo>& all_tables() {
  static const std::vector<TableInfo> kAll = [] {
    std::vector<TableInfo> all;
    for (const ObserverKind& kind : observer_kinds()) {
      for (const auto& table : kind.tables) {
        all.push_back(table({}));
      }
    }
    std::stable_partition(all.begin(), all.end(),
                          [](const TableInfo& table) { return table.name == "series"; });
    return all;
  }();
  return kAll;
}

constexpr const char* kTrajectory = "trajectory";

using NamedTable = std::pair<std::string, const TableInfo*>;

/// By the names that columns_table() takes; the trajectory is none of them.
std::vector<NamedTable> named_tables() {
  std::vector<NamedTable> named;
  const auto add = [&named](const std::string& prefix, const std::vector<TableInfo>& tables) {
    for (const TableInfo& table : tables) {
      named.emplace_back(prefix + std::string(table.name), &table);
    }
  };
  add("", all_tables());
  add("gas.", gas_tables());
  add("sweep.", sweep_tables());
  return named;
}

/// x or y of a column of a vector; empty for others.
std::string_view part_of_vector(const Quantity& quantity, std::string_view column) {
  const std::string_view end = column.substr(std::min(quantity.key.size(), column.size()));
  const bool is_part = column.starts_with(quantity.key);
  return is_part && (end == "x" || end == "y") ? end : "";
}

store::ColumnSummary summary_of(std::string_view key, const Quantity& quantity,
                                const std::optional<scene::Conversion>& units) {
  const std::size_t dot = key.find('.');
  return {.key = std::string(key),
          .name = std::string(quantity.name),
          .of = std::string(dot == std::string_view::npos ? part_of_vector(quantity, key)
                                                          : key.substr(dot + 1)),
          .unit = shown_unit(quantity.unit, units),
          .meaning = std::string(quantity.meaning)};
}

/// `is_of_each`: KEY of a column KEY.NAME.
const Quantity* find_column(std::span<const TableInfo> tables, std::string_view name,
                            bool is_of_each = false) {
  for (const TableInfo& table : tables) {
    const auto found = std::ranges::find_if(table.columns, [&](const ColumnInfo& column) {
      return column.of_each.empty() != is_of_each && std::ranges::count(column.names(), name) > 0;
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

const Quantity* find_quantity(std::string_view key) {
  const std::string_view whole = key.substr(0, key.find('.'));
  for (const QuantityGroup& group : stage_quantities()) {
    if (const Quantity* found = find_in(group.quantities, whole)) {
      return found;
    }
  }
  const bool has_name = whole != key;  // KEY.NAME: those of each wall or outlet first
  for (const bool is_of_each : {has_name, !has_name}) {
    if (const Quantity* found = find_column(all_tables(), whole, is_of_each)) {
      return found;
    }
  }
  return find_in(sweep_quantities(), whole);
}

const Quantity* find_gas_quantity(std::string_view key) {
  return find_in(gas_quantities(), key);
}

const Quantity* find_sweep_quantity(std::string_view key) {
  const Quantity* measure = find_in(sweep_quantities(), key.substr(0, key.find('.')));
  const Quantity* of_runs = measure != nullptr ? measure : find_quantity(key);
  return of_runs != nullptr ? of_runs : find_column(sweep_tables(), key);
}

std::vector<NamedQuantity> named_quantities() {
  std::vector<NamedQuantity> all;
  const auto add_measures = [&all](const std::vector<Quantity>& quantities, const char* where) {
    for (const Quantity& quantity : quantities) {
      all.push_back({std::string(quantity.key), &quantity, where, true});
    }
  };
  const auto add_tables = [&all](const std::vector<TableInfo>& tables, const char* of) {
    for (const TableInfo& table : tables) {
      const std::string name(table.name);
      const std::string where =
          (table.kind == TableInfo::Kind::parts ? store::table_name(name, "STAGE")
                                                : store::table_name(name)) +
          of;
      for (const ColumnInfo& column : table.columns) {
        for (const std::string& key : column.names()) {
          all.push_back({key, &column.quantity, where, !column.of_each.empty()});
        }
      }
    }
  };
  for (const QuantityGroup& group : stage_quantities()) {
    add_measures(group.quantities, "run.json, tables of a sweep");
  }
  add_tables(all_tables(), "");
  add_measures(gas_quantities(), "run.json of a gas");
  add_tables(gas_tables(), " of a gas");
  add_measures(sweep_quantities(), "tables of a sweep");
  add_tables(sweep_tables(), " of a sweep");
  return all;
}

std::optional<store::ColumnSummary> KnownQuantities::find(std::string_view key) const {
  const auto own = std::ranges::find(derived, key, &scene::DerivedMeasure::name);
  if (own != derived.end()) {
    return store::ColumnSummary{.key = own->name,
                                .name = own->about.value_or(own->name),
                                .unit = own->unit == "1" ? "" : shown_unit(own->unit, units),
                                .meaning = own->value};
  }
  const Quantity* known = kind == Kind::gas     ? find_gas_quantity(key)
                          : kind == Kind::sweep ? find_sweep_quantity(key)
                                                : find_quantity(key);
  if (known == nullptr) {
    return std::nullopt;
  }
  store::ColumnSummary summary = summary_of(key, *known, units);
  summary.of_floor = known->of_floor;
  return summary;
}

KnownQuantities known_quantities(const store::RunSummary& summary) {
  using Kind = KnownQuantities::Kind;
  return {.kind = summary.kind == "boltzmann" ? Kind::gas
                  : summary.kind == "sweep"   ? Kind::sweep
                                              : Kind::run,
          .units = summary.units,
          .derived = summary.derived};
}

std::vector<store::ColumnSummary> sweep_summary(const std::vector<std::string>& columns,
                                                const KnownQuantities& known) {
  std::vector<store::ColumnSummary> result;
  for (const std::string& key : columns) {
    const std::size_t ending = key.ends_with(kErrorEnding) ? kErrorEnding.size() : 0;
    const std::string of = key.substr(0, key.size() - ending);
    const auto of_stage = known.find(of.substr(of.find('.') + 1));
    const auto found = of_stage ? of_stage : known.find(of);
    result.push_back(found.value_or(store::ColumnSummary{.key = key, .name = key}));
    result.back().key = key;
  }
  return result;
}

std::vector<store::ColumnSummary> RunTable::summary() const {
  std::vector<store::ColumnSummary> result;
  for (const std::string& name : table_.columns()) {
    const Quantity* column = find_column({&info_, 1}, name);
    const Quantity* known =
        column != nullptr ? column : find_column({&info_, 1}, name.substr(0, name.find('.')), true);
    result.push_back(known != nullptr ? summary_of(name, *known, conversion_)
                                      : store::ColumnSummary{.key = name, .name = name});
  }
  return result;
}

std::string shown_unit(std::string_view unit, const std::optional<scene::Conversion>& units) {
  if (const auto si = units ? units->si(unit) : std::nullopt) {
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
  for (const NamedTable& table : named_tables()) {
    names.push_back(table.first);
  }
  return names;
}

std::string columns_table(std::string_view table) {
  if (table == kTrajectory) {
    return store::datasets_table();
  }
  const std::vector<NamedTable> tables = named_tables();
  const auto found = std::ranges::find(tables, table, &NamedTable::first);
  if (found == tables.end()) {
    throw text::InputError(
        fmt::format("no table '{}'; there are {}", table, fmt::join(table_names(), ", ")));
  }
  std::string text = "| column | unit | what |\n|---|---|---|\n";
  for (const ColumnInfo& column : found->second->columns) {
    const Quantity& what = column.quantity;
    const std::string names = !column.of_each.empty()
                                  ? fmt::format("`{}.{}`", what.key, column.of_each)
                              : column.endings.back() == kErrorEnding
                                  ? fmt::format("`{}` (`_se`)", what.key)
                                  : fmt::format("`{}`", fmt::join(column.names(), "`, `"));
    text += fmt::format("| {} | {} | {}{}{} |\n", names, what.unit, described(what),
                        column.where.empty() ? "" : "; ", column.where);
  }
  return text;
}

std::string quantities_table() {
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
