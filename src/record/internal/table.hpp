#pragma once
// Tables of a run: columns that say what they are, and files for their rows.

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <functional>
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

bool is_contact(const scene::Scene& scene);
inline constexpr std::string_view kContactModel = "with `model: contact`";

// In several tables. Behind the step, each table has the time where steps have a length.
inline constexpr Quantity kStep = {"step", "Step", "", "of the whole run"};
inline constexpr Quantity kTime = {"time", "Time", "time", "of the whole run"};
inline constexpr Quantity kStage = {"stage", "Stage", "", "its name"};
inline constexpr Quantity kCellCentre = {"", "Position", "spacings", "of the centre of the cell"};
inline constexpr Quantity kVelocity = {"v", "Velocity", "spacings/step",
                                       "of the particles, mean, weighted by sites"};
inline constexpr Quantity kFluctuation = {"fluctuation", "Energy of fluctuations",
                                          "(spacings/step)²", "½⟨|v - ⟨v⟩|²⟩, weighted by sites"};

/// The unit of velocities in tables: a lattice spacing per step in it.
double velocity_unit(const scene::Scene& scene);

/// What a column is, of any run.
struct ColumnInfo {
  Quantity quantity;
  std::string_view where;                 ///< as ColumnGroup::where
  std::vector<std::string_view> endings;  ///< columns KEY + ending: one, or two as below

  std::vector<std::string> names() const;
};

// How values are written. Two columns: a mean, KEY and KEY_se (its standard error), and a vector,
// KEYx and KEYy.
template <class Value>
std::vector<std::string_view> column_endings() {
  if constexpr (std::is_same_v<Value, statistics::Sample>) {
    return {"", kErrorEnding};
  } else if constexpr (std::is_same_v<Value, Eigen::Vector2d> ||
                       std::is_same_v<Value, std::optional<Eigen::Vector2d>>) {
    return {"x", "y"};
  } else {
    return {""};
  }
}
void add_cell(std::vector<store::Cell>& cells, const std::optional<double>& value);
void add_cell(std::vector<store::Cell>& cells, const std::string& text);
void add_cell(std::vector<store::Cell>& cells, const statistics::Sample& mean);
void add_cell(std::vector<store::Cell>& cells, const std::optional<Eigen::Vector2d>& vector);
void add_cell(std::vector<store::Cell>& cells, std::integral auto number) {
  cells.emplace_back(static_cast<std::uint64_t>(number));
}

/// A column and what takes its value from what a row is made of: a member or a function.
template <class Row>
struct Column {
  template <class Value>
  Column(const Quantity& quantity, Value value)
      : info{quantity, "", column_endings<std::decay_t<std::invoke_result_t<Value, const Row&>>>()},
        add([value](std::vector<store::Cell>& cells, const Row& row) {
          add_cell(cells, std::invoke(value, row));
        }) {}

  ColumnInfo info;
  std::function<void(std::vector<store::Cell>&, const Row&)> add;
};

/// What a table is, of any run.
struct TableInfo {
  enum class Kind : std::uint8_t {
    growing,  ///< NAME.csv, to which rows are added while it runs
    whole,    ///< NAME.csv, written at once
    parts     ///< NAME-STAGE.csv, written at the end of the stage, or NAME-TIME.csv
  };

  std::string_view name;
  Kind kind = Kind::growing;
  /// Of each wall or outlet, KEY.NAME: the quantity, and what NAME is.
  std::vector<std::pair<Quantity, std::string_view>> of_each = {};
  std::vector<ColumnInfo> columns = {};

  const TableInfo& info() const { return *this; }
};

/// Columns that are there for some scenes.
template <class Row>
struct ColumnGroup {
  std::string_view where;  ///< Markdown, as `with ...`; empty: all
  bool is_there = false;   ///< for this scene
  std::vector<Column<Row>> columns;
};

/// The same for a scene, with the values of its columns.
template <class Row>
struct TableOf : TableInfo {
  TableOf(const TableInfo& info, std::vector<Column<Row>> always,
          const std::vector<ColumnGroup<Row>>& sometimes = {})
      : TableInfo(info), groups({{"", true, std::move(always)}}) {
    groups.insert(groups.end(), sometimes.begin(), sometimes.end());
    for (ColumnGroup<Row>& group : groups) {
      for (Column<Row>& column : group.columns) {
        column.info.where = group.where;
        columns.push_back(column.info);
        if (column.info.quantity.key == kStep.key) {
          columns.push_back({kTime, kContactModel, {""}});
        }
      }
    }
  }

  /// Memory for so many rows as text, most numbers of which have fewer than ten characters.
  double bytes(double rows) const {
    std::size_t cells = 0;
    for (const ColumnGroup<Row>& group : groups) {
      cells += group.is_there ? group.columns.size() : 0;
    }
    return grains::kListRoom * 10 * static_cast<double>(cells) * rows;
  }

  std::vector<ColumnGroup<Row>> groups;
};

/// What the tables of a run have in common.
struct TableScope {
  std::vector<std::string> parts;  ///< names of the stages, or times
  bool has_errors = true;
  std::optional<scene::Conversion> conversion = {};  ///< for the time behind each step
};
TableScope table_scope(const scene::Scene& scene);
TableScope table_scope(const scene::BoltzmannScene& scene);

/// A table of one run, in its folder.
class RunTable {
 public:
  const TableInfo& info() const { return info_; }
  /// See scene::Conversion::mean_mass: of the rows from now on.
  void set_mean_mass(double sites) {
    if (scope_.conversion) {
      scope_.conversion->mean_mass = sites;
    }
  }
  /// What its columns are.
  std::vector<store::ColumnSummary> summary() const;

  /// Bytes of a growing table that are on the disk when a run resumes.
  std::uint64_t& bytes() { return bytes_; }
  /// Of a growing table: removes what was written beyond these bytes.
  void open(const store::OutputFolder& folder);
  /// Of a growing table: writes the new rows if they have at least `least` bytes. Forgets them if
  /// the table is not open.
  void write_rows(std::size_t least);
  /// Whether there is no row to write.
  bool is_empty() const { return table_.waiting() == 0; }
  /// Of others: writes the rows since the last call, or forgets them without a folder.
  void write(const store::OutputFolder* folder, const std::string& part = "");

 protected:
  RunTable(TableInfo info, TableScope scope) : info_(std::move(info)), scope_(std::move(scope)) {}

  const TableScope& scope() const { return scope_; }
  void set_columns(const std::vector<std::string>& names) { table_ = store::Table(names); }
  void add_row(std::vector<store::Cell> cells) { table_.add_row(std::move(cells)); }

 private:
  TableInfo info_;
  TableScope scope_;
  store::Table table_{{}};
  std::uint64_t bytes_ = 0;
  std::optional<store::GrowingFile> file_;
};

template <class Row>
class TableWriter : public RunTable {
 public:
  /// `more`: names of the columns of_each.
  TableWriter(TableScope scope_of_run, const TableOf<Row>& table,
              const std::vector<std::string>& more = {})
      : RunTable(table.info(), std::move(scope_of_run)) {
    std::vector<std::string> names;
    for (const ColumnGroup<Row>& group : table.groups) {
      if (!group.is_there) {
        continue;
      }
      for (const Column<Row>& column : group.columns) {
        columns_.push_back(column);
        for (const std::string& name : column.info.names()) {
          names.push_back(name);
        }
        if (is_mean(column) && !scope().has_errors) {
          names.pop_back();
        } else if (has_time(column)) {
          names.emplace_back(kTime.key);
        }
      }
    }
    names.insert(names.end(), more.begin(), more.end());
    set_columns(names);
  }

  /// `more`: cells of the columns of_each.
  void add(const Row& row, const std::vector<store::Cell>& more = {}) {
    std::vector<store::Cell> cells;
    for (const Column<Row>& column : columns_) {
      const std::size_t first = cells.size();
      column.add(cells, row);
      for (std::size_t cell = first; scope().conversion && cell < cells.size(); ++cell) {
        if (auto* value = std::get_if<double>(&cells[cell])) {
          *value = scope().conversion->in_si(*value, column.info.quantity.unit);
        }
      }
      if (is_mean(column) && !scope().has_errors) {
        cells.pop_back();
      } else if (has_time(column)) {
        cells.emplace_back(scope().conversion->time(std::get<std::uint64_t>(cells.back())));
      }
    }
    cells.insert(cells.end(), more.begin(), more.end());
    add_row(std::move(cells));
  }

 private:
  static bool is_mean(const Column<Row>& column) {
    return column.info.endings.back() == kErrorEnding;
  }
  bool has_time(const Column<Row>& column) const {
    return scope().conversion && column.info.quantity.key == kStep.key;
  }

  std::vector<Column<Row>> columns_;
};

}  // namespace clca::record
