#pragma once
// Measures that a scene derives from others by expressions.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clca/scene/output.hpp"

namespace clca::scene {

/// The names of measures in an expression, as they come: all names but functions and constants.
std::vector<std::string> names_in(std::string_view expression);

/// The value of an expression of measures, `values` of which are known; none if one of them has no
/// value, or the result is not a finite number.
std::optional<double> value_of(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& values);

}  // namespace clca::scene
