#pragma once
// Lines and arrows drawn over the particles of a picture.

#include <Eigen/Core>
#include <vector>

#include "clca/render/image.hpp"

namespace clca::render {

/// A straight line with round ends; lattice spacings. An arrow has its head at `to`; one shorter
/// than its width or a pixel is drawn as a dot.
struct Stroke {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double width = 0.5;
  Rgb color = {};
  bool arrow = false;
};

struct Overlay {
  std::vector<Stroke> strokes;  ///< later ones lie on top
  double fade = 0;              ///< 0 to 1: how far everything below is faded to white
};

}  // namespace clca::render
