#pragma once
// Many pictures on one sheet, for an overview.

#include <string>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// An image of width 0 stands for a picture that is missing.
struct LabelledImage {
  Image image;
  std::string label;
};

/// The pictures by rows, each scaled to `cell_width` pixels with its label beneath, under a title.
/// Where one is missing stands a pale box. Without a font there is no text, but room for it.
/// Throws std::invalid_argument unless `columns` and `cell_width` are positive, RenderError for a
/// sheet too large.
Image contact_sheet(const std::vector<LabelledImage>& images, int columns, int cell_width,
                    const std::string& title);

}  // namespace clca::render
