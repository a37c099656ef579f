#pragma once
// Tables of a run: columns that say what they are, and files for their rows.

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "clca/run/quantity.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/growing_file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/table.hpp"

namespace clca::run {

/// For which scenes there is a column.
struct Condition {
  std::string_view text = {};  ///< Markdown, as `with ...`; empty: all
  bool (*holds)(const scene::Scene& scene) = nullptr;
};

bool is_contact(const scene::Scene& scene);
inline constexpr Condition kContactModel = {"with `model: contact`", is_contact};

// In several tables. Behind the step, each table has the time where steps have a length.
inline constexpr Quantity kStep = {"step", "Step", "", "of the whole run"};
inline constexpr Quantity kTime = {"time", "Time", "time", "of the whole run"};
inline constexpr Quantity kStage = {"stage", "Stage", "", "its name"};
inline constexpr Quantity kCellX = {"x", "x", "spacings", "of the centre of the cell"};
inline constexpr Quantity kCellY = {"y", "y", "spacings", "of the centre of the cell"};
inline constexpr Quantity kFluctuation = {"fluctuation", "Energy of fluctuations",
                                          "(spacings/step)²", "½⟨|v - ⟨v⟩|²⟩, weighted by sites"};

/// The unit of velocities in tables: a lattice spacing per step in it.
double velocity_unit(const scene::Scene& scene);

/// A column and what takes its value from what a row is made of: a member, or a function that
/// returns a number, an optional number or a text.
template <class Row>
struct Column {
  template <class Value>
  Column(const Quantity& column, Value value, const Condition& condition = {})
      : quantity(column), where(condition), cell([value](const Row& row) -> store::Cell {
          using Result = std::decay_t<std::invoke_result_t<Value, const Row&>>;
          if constexpr (std::is_same_v<Result, std::optional<double>>) {
            return std::invoke(value, row).value_or(std::numeric_limits<double>::quiet_NaN());
          } else if constexpr (std::is_integral_v<Result>) {
            return static_cast<std::uint64_t>(std::invoke(value, row));
          } else {
            return std::invoke(value, row);
          }
        }) {}

  Quantity quantity;
  Condition where;
  std::function<store::Cell(const Row& row)> cell;
};

/// What a table is, of any run.
struct TableInfo {
  enum class Of : std::uint8_t {
    run,    ///< NAME.csv, to which rows are added while it runs
    stages  ///< NAME-STAGE.csv, written at the end of the stage
  };

  std::string_view name;
  Of of = Of::run;
  bool is_certain = false;  ///< a run that has the table writes it whatever happens
  /// Of each wall or outlet, KEY.NAME: the quantity, and what NAME is.
  std::vector<std::pair<Quantity, std::string_view>> of_each = {};
  std::vector<std::pair<Quantity, Condition>> columns = {};
};

/// The same with the values of its columns.
template <class Row>
struct TableOf : TableInfo {
  TableOf(const TableInfo& info, std::initializer_list<Column<Row>> all)
      : TableInfo(info), values(all) {
    for (const Column<Row>& column : values) {
      columns.emplace_back(column.quantity, column.where);
      if (column.quantity.key == kStep.key) {
        columns.emplace_back(kTime, kContactModel);
      }
    }
  }

  std::vector<Column<Row>> values;
};

/// A table of one run, in its folder.
class RunTable {
 public:
  /// `more`: names of the columns of_each. `scene` and `info` outlive the table.
  RunTable(const scene::Scene& scene, const TableInfo& info, std::vector<std::string> more = {});

  const TableInfo& info() const { return info_; }
  /// Names of its files.
  std::vector<std::string> files() const;
  /// Without the time.
  void add_row(std::vector<store::Cell> cells);

  /// Bytes of rows that are on the disk when a run resumes.
  std::uint64_t& bytes() { return bytes_; }
  /// Removes what was written beyond these bytes.
  void open(const store::OutputFolder& folder);
  /// Of the run: writes the new rows if they have at least `least` bytes.
  void write_rows(std::size_t least);
  /// Of stages: writes the table of a stage.
  void write(const std::string& stage);

 protected:
  const scene::Scene& scene() const { return scene_; }

 private:
  const scene::Scene& scene_;
  const TableInfo& info_;
  std::optional<scene::Conversion> conversion_;
  std::optional<std::size_t> time_;  // its column
  store::Table table_;
  std::uint64_t bytes_ = 0;
  std::optional<store::OutputFolder> folder_;
  std::optional<store::GrowingFile> file_;
};

template <class Row>
class TableWriter : public RunTable {
 public:
  explicit TableWriter(const scene::Scene& scene, const TableOf<Row>& table,
                       std::vector<std::string> more = {})
      : RunTable(scene, table, std::move(more)) {
    for (const Column<Row>& column : table.values) {
      if (column.where.holds == nullptr || column.where.holds(scene)) {
        columns_.push_back(&column);
      }
    }
  }

  /// `more`: cells of the columns of_each.
  void add(const Row& row, const std::vector<store::Cell>& more = {}) {
    std::vector<store::Cell> cells;
    for (const Column<Row>* column : columns_) {
      cells.push_back(column->cell(row));
    }
    cells.insert(cells.end(), more.begin(), more.end());
    add_row(std::move(cells));
  }

 private:
  std::vector<const Column<Row>*> columns_;  // those that the scene has
};

}  // namespace clca::run
