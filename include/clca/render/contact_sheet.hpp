#pragma once
// Many pictures on one sheet, for an overview.

#include <string>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// An image of width 0 is a missing picture.
struct LabelledImage {
  Image image;
  std::string label;
};

/// The pictures in rows under a title, each scaled to `cell_width` pixels with its label below.
/// Missing pictures are pale boxes. Without a font there is no text.
/// Throws std::invalid_argument unless `columns` and `cell_width` are positive, RenderError if the
/// sheet is too large.
Image contact_sheet(const std::vector<LabelledImage>& images, int columns, int cell_width,
                    const std::string& title);

}  // namespace clca::render
