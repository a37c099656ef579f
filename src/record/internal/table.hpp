#pragma once
// Tables of a run: columns that say what they are, and files for their rows.

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/record/quantity.hpp"
#include "clca/scene/boltzmann.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/statistics/sample.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/table.hpp"

namespace clca::record {

bool is_contact_model(const scene::Scene& scene);
inline constexpr std::string_view kContactModel = "with `model: contact`";

// Quantities of several tables. The time follows the step where steps have a length.
inline constexpr Quantity kStep = {"step", "Step", "", "of the whole run"};
inline constexpr Quantity kTime = {"time", "Time", "time", "of the whole run"};
inline constexpr Quantity kStage = {"stage", "Stage", "", "its name"};
inline constexpr Quantity kCellCentre = {"", "Position", "spacings", "of the centre of the cell"};
inline constexpr Quantity kVelocity = {"v", "Velocity", "spacings/step",
                                       "of the particles, mean, weighted by sites"};
inline constexpr Quantity kFluctuation = {"fluctuation", "Energy of fluctuations",
                                          "(spacings/step)²", "½⟨|v - ⟨v⟩|²⟩, weighted by sites"};

/// One lattice spacing per step, in the unit of velocities of the tables.
double velocity_factor(const scene::Scene& scene);

/// Description of a column.
struct ColumnInfo {
  Quantity quantity;
  std::vector<std::string_view> suffixes = {""};  ///< columns KEY + ending: one, or two as below
  std::string_view condition = {};                ///< as in ColumnGroup
  bool is_present = true;                         ///< in tables of the scene, where one is given
  /// Not empty: columns KEY.NAME, of each wall or outlet; what NAME is.
  std::string_view of_each = {};

  std::vector<std::string> column_names() const;
};

// Values with two columns: a mean, KEY and KEY_se (its standard error); a vector, KEYx and KEYy.
template <class Value>
std::vector<std::string_view> column_endings() {
  if constexpr (std::is_same_v<Value, statistics::SampleStatistics>) {
    return {"", kErrorSuffix};
  } else if constexpr (std::is_same_v<Value, Eigen::Vector2d> ||
                       std::is_same_v<Value, std::optional<Eigen::Vector2d>>) {
    return {"x", "y"};
  } else {
    return {""};
  }
}
void add_cell(std::vector<store::Cell>& cells, const std::optional<double>& value);
void add_cell(std::vector<store::Cell>& cells, const std::string& text);
void add_cell(std::vector<store::Cell>& cells, const statistics::SampleStatistics& mean);
void add_cell(std::vector<store::Cell>& cells, const std::optional<Eigen::Vector2d>& vector);
void add_cell(std::vector<store::Cell>& cells, std::integral auto number) {
  cells.emplace_back(static_cast<std::uint64_t>(number));
}

/// A column and the member or function of a Row that gives its value.
template <class Row>
struct Column : ColumnInfo {
  template <class Value>
  Column(const Quantity& what, Value value)
      : ColumnInfo{what, column_endings<std::decay_t<std::invoke_result_t<Value, const Row&>>>()},
        add([value](std::vector<store::Cell>& cells, const Row& row) {
          add_cell(cells, std::invoke(value, row));
        }) {}

  std::function<void(std::vector<store::Cell>&, const Row&)> add;
};

/// Description of a table.
struct TableInfo {
  enum class Kind : std::uint8_t {
    growing,  ///< NAME.csv, to which rows are added while it runs
    whole,    ///< NAME.csv, written at once
    parts     ///< NAME-STAGE.csv, written at the end of the stage, or NAME-TIME.csv
  };

  std::string_view name;
  Kind kind = Kind::growing;
  std::vector<ColumnInfo> columns = {};

  const TableInfo& info() const { return *this; }
};

/// Columns that are there for some scenes.
template <class Row>
struct ColumnGroup {
  std::string_view condition;  ///< Markdown, as `with ...`; empty: all
  bool is_present = false;     ///< for this scene
  std::vector<Column<Row>> columns;
};

/// A TableInfo for a scene, with the functions that take the values of its columns from a Row.
template <class Row>
struct TableOf : TableInfo {
  /// `info`: with columns of each wall or outlet only (of_each), which come last.
  TableOf(const TableInfo& info, std::vector<Column<Row>> always,
          const std::vector<ColumnGroup<Row>>& sometimes = {})
      : TableInfo{info.name, info.kind}, values(std::move(always)) {
    for (const ColumnGroup<Row>& group : sometimes) {
      for (Column<Row> column : group.columns) {
        column.condition = group.condition;
        column.is_present = group.is_present;
        values.push_back(column);
      }
    }
    for (const Column<Row>& column : values) {
      columns.push_back(column);
      if (column.quantity.key == kStep.key) {
        columns.push_back({.quantity = kTime, .condition = kContactModel});
      }
    }
    columns.insert(columns.end(), info.columns.begin(), info.columns.end());
  }

  /// Memory for so many rows as text, most numbers of which have fewer than ten characters.
  double bytes(double rows) const {
    return grains::kListCapacityRatio * 10 * rows *
           static_cast<double>(std::ranges::count(values, true, &Column<Row>::is_present));
  }

  std::vector<Column<Row>> values;
};

/// A table of one run, in its folder.
class RunTable {
 public:
  const TableInfo& info() const { return info_; }
  /// Sets UnitConversion::mean_mass for the rows from now on.
  void set_mean_mass(double sites) {
    if (conversion_) {
      conversion_->mean_mass = sites;
    }
  }
  /// Descriptions of its columns.
  std::vector<store::ColumnSummary> column_descriptions() const;

  /// Bytes of a growing table that are on the disk when a run resumes.
  std::uint64_t& saved_bytes() { return bytes_; }
  /// Growing table: throws StoreError if these bytes are not on the disk.
  void check_saved_bytes(const store::OutputFolder& folder) const;
  /// Growing table: removes what was written beyond these bytes.
  void open(const store::OutputFolder& folder);
  /// Growing table: writes the new rows if they have `least` bytes; forgets them unless open.
  void write_rows(std::size_t least);
  /// Whether there is no row to write.
  bool has_no_new_rows() const { return table_.pending_bytes() == 0; }
  /// Other tables: writes the rows since the last call, or forgets them without a folder.
  void write(const store::OutputFolder* folder, const std::string& part = "");

 protected:
  RunTable(TableInfo info, const scene::Scene& scene)
      : conversion_(scene::unit_conversion(scene)), info_(std::move(info)) {}
  /// Table of a gas: has standard errors if the ensemble has several members.
  RunTable(TableInfo info, const scene::BoltzmannScene& scene)
      : has_errors_(scene.ensemble_size > 1), info_(std::move(info)) {}

  void set_columns(const std::vector<std::string>& names) { table_ = store::Table(names); }
  void add_row(std::vector<store::Cell> cells) { table_.add_row(std::move(cells)); }
  bool has_errors() const { return has_errors_; }
  const std::optional<scene::UnitConversion>& conversion() const { return conversion_; }

 private:
  bool has_errors_ = true;
  std::optional<scene::UnitConversion> conversion_ = {};  // for the time behind each step
  TableInfo info_;
  store::Table table_{{}};
  std::uint64_t bytes_ = 0;
  std::optional<store::GrowingFile> file_;
};

template <class Row>
class TableWriter : public RunTable {
 public:
  /// `more`: names of the columns of each wall or outlet.
  TableWriter(const auto& scene, const TableOf<Row>& table,
              const std::vector<std::string>& more = {})
      : RunTable(table.info(), scene) {
    std::vector<std::string> names;
    for (const Column<Row>& column : table.values) {
      if (!column.is_present) {
        continue;
      }
      columns_.push_back(column);
      std::ranges::move(column.column_names(), std::back_inserter(names));
      if (lacks_error(column)) {
        names.pop_back();
      } else if (has_time(column)) {
        names.emplace_back(kTime.key);
      }
    }
    names.insert(names.end(), more.begin(), more.end());
    set_columns(names);
  }

  /// `more`: their cells.
  void add(const Row& row, const std::vector<store::Cell>& more = {}) {
    std::vector<store::Cell> cells;
    for (const Column<Row>& column : columns_) {
      const std::size_t first = cells.size();
      column.add(cells, row);
      for (std::size_t cell = first; conversion() && cell < cells.size(); ++cell) {
        if (auto* value = std::get_if<double>(&cells[cell])) {
          *value = conversion()->in_si(*value, column.quantity.unit);
        }
      }
      if (lacks_error(column)) {
        cells.pop_back();
      } else if (has_time(column)) {
        cells.emplace_back(conversion()->time(std::get<std::uint64_t>(cells.back())));
      }
    }
    cells.insert(cells.end(), more.begin(), more.end());
    add_row(std::move(cells));
  }

 private:
  bool lacks_error(const Column<Row>& column) const {
    return !has_errors() && column.suffixes.back() == kErrorSuffix;
  }
  bool has_time(const Column<Row>& column) const {
    return conversion() && column.quantity.key == kStep.key;
  }

  std::vector<Column<Row>> columns_;
};

}  // namespace clca::record
