#pragma once
// What the numbers in run.json and in the tables of a run are.

#include <optional>
#include <string>
#include <string_view>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/scene/units.hpp"

namespace clca::run {

struct Quantity {
  std::string_view key;      ///< in run.json, or the name of a column
  std::string_view name;     ///< in words
  std::string_view unit;     ///< as for shown_unit; of a pure number empty
  std::string_view meaning;  ///< may be empty
};

/// Of a run of grains or a sweep, also of one outlet or wall, KEY.OUTLET, and of a part of a
/// vector, KEYx; null if there is none of this key.
const Quantity* find_quantity(std::string_view key);
/// Of a gas.
const Quantity* find_gas_quantity(std::string_view key);

/// `unit` with the unit of velocity for `spacings/step` and that of time for `time`, where a run
/// has them.
std::string shown_unit(std::string_view unit, const std::optional<scene::Conversion>& units);

/// What a grain touches, as tables of contacts name it: a grain by its number, a wall by its name,
/// a side of the box as `box.floor`.
std::string body_name(const scene::Scene& scene, grains::Owner owner);

/// The measures of a stage as a table in Markdown: measure, name in run.json, unit, what.
std::string quantities_table();
/// The columns of a table of a run, such as `series`, of a gas `gas.series`, or the datasets of the
/// `trajectory`, likewise. Throws text::InputError for one that there is not.
std::string columns_table(std::string_view table);

}  // namespace clca::run
