#pragma once
// Captions, legend and scale bar around the view of a picture.

#include <string>
#include <vector>

#include "clca/render/painter.hpp"
#include "render/graphics.hpp"
#include "render/layout.hpp"

namespace clca::render {

/// Largest of 1, 2 and 5 times a power of ten not above `length` (positive).
double round_length(double length);

/// A length given in metres, written in the largest of m, mm and µm that makes it at least 1.
std::string metres_text(double length);

/// Round numbers from `low` to `high`, at most `count` of them.
std::vector<double> ticks(double low, double high, int count);

/// Draws them where `layout` has room for text.
PictureParts annotate(Graphics& graphics, const Layout& layout, const Caption& caption,
                      const Legend& legend);

}  // namespace clca::render
