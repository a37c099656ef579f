#pragma once
// Captions, legend and scale bar around the view of a picture.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "clca/render/painter.hpp"
#include "render/graphics.hpp"
#include "render/layout.hpp"

namespace clca::render {

/// Round numbers from `low` to `high`, at most `count` of them.
std::vector<double> tick_values(double low, double high, int count);

/// Draws captions, legend and scale bar where `layout` has room for text.
void annotate(Graphics& graphics, const Layout& layout, const Caption& caption,
              const Legend& legend);

/// A legend entry, or the ellipsis for omitted entries.
struct LegendItem {
  std::optional<std::size_t> entry_index;  ///< none: the ellipsis
  double left = 0;                         ///< from the beginning of the line
  int line = 0;

  bool operator==(const LegendItem&) const = default;
};

/// Places entries of the given `widths`, `gap` apart, in as few lines as possible; `rooms` are the
/// line widths.
/// If there are too many, an ellipsis replaces those before the last. Empty if not even that fits.
std::vector<LegendItem> placed_legend_items(std::span<const double> widths, double ellipsis,
                                            double gap, std::span<const double> rooms);

}  // namespace clca::render
