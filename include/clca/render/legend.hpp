#pragma once
// The legend of a picture.

#include <string>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// Named colour patches, a colour bar, and lines or arrows as in the overlay.
struct Legend {
  struct Patch {
    std::string label;
    Rgb color;
  };
  struct Bar {
    std::string label;  ///< with the unit
    double low = 0;
    double high = 1;
  };
  struct Line {
    std::string label;
    double width = 0.5;  ///< lattice spacings; drawn no thicker than a line of text
    double length = 0;   ///< lattice spacings; 0 where it tells nothing
    Rgb color = {};
    bool arrow = false;
  };
  std::vector<Patch> patches;
  std::vector<Bar> bars;  ///< none or one
  std::vector<Line> lines;
};

}  // namespace clca::render
