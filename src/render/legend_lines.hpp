#pragma once
// Where the entries of a legend go when a line is short.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace clca::render {

/// An entry of a legend, or the ellipsis that stands for those left out.
struct LegendItem {
  std::optional<std::size_t> entry;  ///< none: the ellipsis
  double left = 0;                   ///< from the beginning of the line
  int line = 0;

  bool operator==(const LegendItem&) const = default;
};

/// Sets entries as wide as `widths`, `gap` apart, in as few lines as need be; `rooms` are the
/// widths of the lines. Where they are too many, an ellipsis takes the place of those before the
/// last. Empty when there is no room even for that.
std::vector<LegendItem> legend_lines(std::span<const double> widths, double ellipsis, double gap,
                                     std::span<const double> rooms);

}  // namespace clca::render
