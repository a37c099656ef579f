#pragma once
// What the numbers in run.json and in the tables of a run are.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/summary.hpp"

namespace clca::record {

struct Quantity {
  std::string_view key;      ///< in run.json, or the name of a column
  std::string_view name;     ///< in words
  std::string_view unit;     ///< as for shown_unit; empty: a pure number
  std::string_view meaning;  ///< may be empty
  bool is_relative_to_floor =
      false;  ///< measured from the floor of the vessel: of little use if it is turned
};

/// Suffix of columns with standard errors of means.
inline constexpr std::string_view kErrorSuffix = "_se";

/// A name in run.json or in tables, and what it stands for.
struct NamedQuantity {
  std::string name;
  const Quantity* quantity;
  std::string file;         ///< such as `series.csv`
  bool is_of_each = false;  ///< there may be NAME.OUTLET or NAME.WALL, too
};
/// All that are declared; a name may come several times.
std::vector<NamedQuantity> named_quantities();

/// The quantities of one run or sweep.
struct KnownQuantities {
  enum class Kind : std::uint8_t { run, gas, sweep };

  Kind kind = Kind::run;
  std::optional<scene::UnitConversion> units = {};
  std::vector<scene::DerivedMeasure> derived_measures = {};

  /// The quantity of this key, declared or derived by the scene.
  std::optional<store::ColumnSummary> find(std::string_view key) const;
};

/// The quantity of a key, also of one outlet or wall, KEY.OUTLET, and of a part of a vector, KEYx;
/// null if there is none of this key. Kind::sweep: of the tables of a sweep over runs of grains.
const Quantity* find_quantity(std::string_view key,
                              KnownQuantities::Kind kind = KnownQuantities::Kind::run);

KnownQuantities known_quantities(const store::RunSummary& summary);

/// The columns of a table of a sweep, or its measures if `table` is empty; `known`: of the runs, of
/// those without units last. The unit is `units differ` where runs have several.
std::vector<store::ColumnSummary> sweep_column_summaries(std::string_view table,
                                                         const std::vector<std::string>& columns,
                                                         const std::vector<KnownQuantities>& known);
/// Measures that only a sweep has.
std::vector<std::string> sweep_measure_names();

/// Checks that the names in derived measures are those of measures that the scene takes. Throws
/// scene::SceneError for the first that is not.
void check_derived(const scene::Scene& scene);

/// `unit` with the unit of velocity for `spacings/step`, that of time for `time` and that of
/// scene::UnitConversion::si_unit() for one of masses, where a run has them.
std::string shown_unit(std::string_view unit, const std::optional<scene::UnitConversion>& units);

/// A body in tables of contacts: number of a grain, name of a wall, or a side such as `box.floor`.
std::string body_name(const scene::Scene& scene, grains::Owner owner);
/// All walls, then the sides of the box.
std::vector<grains::Owner> walls_and_sides(const scene::Scene& scene);

/// The measures of a stage as a table in Markdown: measure, name in run.json, unit, meaning.
std::string quantities_markdown();
/// The columns of a table as a table in Markdown: `series` of a run, `gas.series` of a gas,
/// `sweep.runs`, or the datasets of `trajectory`. Throws text::InputError for an unknown table.
std::string columns_markdown(std::string_view table);
/// All that columns_markdown() takes.
std::vector<std::string> table_names();
/// The names of the columns of `runs`, `measures` or `mean`, a table of a sweep, with `names` in
/// place of those that are declared in capitals.
std::vector<std::string> sweep_column_names(
    std::string_view table, const std::map<std::string_view, std::vector<std::string>>& names);

}  // namespace clca::record
