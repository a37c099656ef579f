#pragma once
// Text that describes something in YAML, and what is wrong in it; expressions whose names get their
// values later, such as those of measures.

#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace clca::document {

/// Maximum size of the text. The parser may need 250 times that in memory.
inline constexpr std::size_t kMaxBytes = std::size_t{4} << 20U;

/// An error in the text. what() is one line: `FILE:LINE:COLUMN: error: MESSAGE`.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One text for all texts with the same value: `0.5` for 0.50 and =1/2. Text that is no YAML, or
/// depends on names under `let`, stays as it is.
std::string canonical_value(const std::string& text);

/// The names in an expression, as they come: all but functions and constants. One with '-' behind a
/// dot is a name if it is known, else a difference.
std::vector<std::string> names_in(
    std::string_view expression, const std::function<bool(std::string_view name)>& is_known =
                                     [](std::string_view /*name*/) { return false; });

/// The value of an expression; `values` gives those of its names. None if a name has no value, or
/// the result is not finite.
std::optional<double> expression_value(
    std::string_view expression,
    const std::function<std::optional<double>(std::string_view name)>& values);

}  // namespace clca::document
