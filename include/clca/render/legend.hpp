#pragma once
// What explains the colours of a picture.

#include <string>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// Named patches, a bar of a colour map from low to high, and lines or arrows as the overlay has
/// them.
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
