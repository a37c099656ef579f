#pragma once
// Many pictures on one sheet, for an overview.

#include <string>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// A picture of a contact sheet; a view of width 0 is a missing one.
struct Tile {
  Image view;
  Image legend;  ///< of width 0 where there is none
  std::string label;
};

/// The tile of a picture, its view (or all of it) resized to `width` pixels, or less where it is
/// tall. A scale bar would not hold any more, so it is left out.
Tile tile(const Image& picture, const PictureParts& parts, int width, std::string label);

/// The tiles in rows under a title, each in a cell `cell_width` pixels wide, with its label below.
/// A legend that all tiles have stands below them once, others below their tiles. Missing pictures
/// are pale boxes. Without a font there is no text.
/// Throws std::invalid_argument unless `columns` and `cell_width` are positive, RenderError if the
/// sheet is too large.
Image contact_sheet(const std::vector<Tile>& tiles, int columns, int cell_width,
                    const std::string& title);

/// The pictures in a row, as high as the highest one, white below the others.
Image side_by_side(const std::vector<Image>& pictures);

}  // namespace clca::render
