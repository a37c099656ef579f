#pragma once
// What the measures in run.json mean.

#include <string_view>

namespace clca::report {

struct MeasureName {
  std::string_view key;   ///< in run.json
  std::string_view name;  ///< in words
  std::string_view unit;
  std::string_view meaning;
};

/// None where the name is not known.
const MeasureName* find_measure_name(std::string_view key);

}  // namespace clca::report
