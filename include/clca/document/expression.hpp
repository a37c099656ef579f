#pragma once
// Expressions whose names get their values later, such as those of measures.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clca::document {

/// The names in an expression, as they come: all but functions and constants. One with '-' behind a
/// dot is a name if it is known, else a difference.
std::vector<std::string> names_in(
    std::string_view expression, const std::function<bool(std::string_view name)>& is_known =
                                     [](std::string_view /*name*/) { return false; });

/// The value of an expression, `values` of whose names are known; none if one of them has no value,
/// or the result is not a finite number.
std::optional<double> value_of(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& values);

}  // namespace clca::document
