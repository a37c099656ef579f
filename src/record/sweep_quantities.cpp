// What the tables of a sweep have besides the measures of its runs.

#include <algorithm>

#include "record/internal/quantities.hpp"
#include "record/internal/table.hpp"

namespace clca::record {

namespace {

TableInfo sweep_table(std::string_view name, const std::vector<Quantity>& columns) {
  TableInfo table = {.name = name, .kind = TableInfo::Kind::whole};
  for (const Quantity& column : columns) {
    table.columns.push_back({column});
  }
  return table;
}

}  // namespace

const std::vector<Quantity>& sweep_quantities() {
  static const std::vector<Quantity> kAll = {
      {"steps", "Steps", "", "of the stage"},
      {"time", "Time", "time", "of the stage"},
      {"discharged_until_clog", "Discharged until a clog", "particles",
       "all that left in the runs, over the number of clogs"}};
  return kAll;
}

std::vector<std::string> sweep_measures() {
  std::vector<std::string> keys;
  for (const Quantity& quantity : sweep_quantities()) {
    keys.emplace_back(quantity.key);
  }
  return keys;
}

const std::vector<TableInfo>& sweep_tables() {
  static constexpr Quantity kVaried = {"KEY", "Value", "", "of each key that varies"};
  static const std::vector<TableInfo> kAll = [] {
    std::vector<TableInfo> all = {
        sweep_table("runs",
                    {kVaried,
                     {"seed", "Seed", "", ""},
                     {"status", "Status", "",
                      "`done`, `failed`, `interrupted` or `waiting` (not begun); only runs that "
                      "are done have numbers"},
                     {"steps", "Steps", "", "of the whole run"},
                     {"state_hash", "State hash", "", "of the final state"},
                     {"STAGE.MEASURE", "Measure", "",
                      "each of each stage; `STAGE.steps` and, with `model: contact`, `STAGE.time` "
                      "are what the stage took"},
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
    all.back().columns.back().endings = {"", kErrorEnding};
    return all;
  }();
  return kAll;
}

std::vector<std::string> sweep_columns(
    std::string_view table, const std::map<std::string_view, std::vector<std::string>>& names) {
  std::vector<std::string> columns;
  for (const ColumnInfo& column :
       std::ranges::find(sweep_tables(), table, &TableInfo::name)->columns) {
    const auto several = names.find(column.quantity.key);
    for (const std::string& key :
         several != names.end() ? several->second : std::vector{std::string(column.quantity.key)}) {
      for (const std::string_view ending : column.endings) {
        columns.push_back(key + std::string(ending));
      }
    }
  }
  return columns;
}

}  // namespace clca::record
