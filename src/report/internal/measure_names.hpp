#pragma once
// Names and meanings of the measures in run.json.

#include <optional>
#include <string>
#include <string_view>

#include "clca/scene/units.hpp"

namespace clca::report {

struct MeasureName {
  std::string_view key;   ///< in run.json
  std::string_view name;  ///< in words
  std::string_view unit;  ///< as for shown_unit
  std::string_view meaning;
};

/// `unit` with the unit of velocity for `spacings/step` and that of time in
/// `sites/time`, where a run has them.
std::string shown_unit(std::string_view unit, const std::optional<scene::Conversion>& units);

/// Also of one outlet, NAME.OUTLET; none if the name is unknown.
const MeasureName* find_measure_name(std::string_view key);

/// The heading of a row of a table: name and meaning of a measure, as HTML.
std::string measure_heading(const std::string& key);

/// The unit of a measure in a run; empty if it is unknown.
std::string unit_of_measure(const std::string& key, const std::optional<scene::Conversion>& units);

}  // namespace clca::report
