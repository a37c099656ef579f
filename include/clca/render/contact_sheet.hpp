#pragma once
// Many pictures on one sheet, for an overview.

#include <string>
#include <vector>

#include "clca/render/image.hpp"
#include "clca/render/legend.hpp"

namespace clca::render {

/// A picture of a contact sheet: the pixels of its view alone. One of width 0 is missing.
struct Tile {
  Image view_image = {};
  double pixels_per_spacing = 1;
  Legend legend = {};
  std::string label = {};
};

/// Width of the cells of a sheet, in pixels, so that all sheets are about as wide.
int cell_width(int columns);

/// Size of the tile of a view, in pixels: `width` wide, or less where the view is tall.
PixelBox tile_size(double view_width, double view_height, int width);

/// The tile of a picture, its view resized to tile_size().
Tile tile(const Image& picture, const PictureView& view, int width);

/// The tiles in rows under a title, each in a cell `cell_width` pixels wide, with its label below.
/// A legend that all tiles have in common stands below them once, others below their tiles. Missing
/// pictures are pale boxes. Without a font there is no text.
/// Throws std::invalid_argument unless `columns` and `cell_width` are positive, RenderError if the
/// sheet is too large.
Image contact_sheet(const std::vector<Tile>& tiles, int columns, int cell_width,
                    const std::string& title);

/// The pictures in a row, as high as the highest one, white below the others.
Image side_by_side(const std::vector<Image>& pictures);

}  // namespace clca::render
