#pragma once
// Many pictures on one sheet.

#include <string>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

struct LabelledImage {
  Image image;  ///< of width 0: a pale empty box stands for it
  std::string label;
};

/// The pictures by rows of `columns`, each `cell_width` pixels wide, with their labels.
Image contact_sheet(const std::vector<LabelledImage>& images, int columns, int cell_width,
                    const std::string& title);

}  // namespace clca::render
