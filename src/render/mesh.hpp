#pragma once
// Triangles that fill the body of a particle and its outline.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/render/body.hpp"

namespace clca::render {

/// A point of the body, or one moved inwards by the outline's width times `inward`.
struct MeshVertex {
  std::int32_t u = 0;  ///< as GridPoint, from the reference site
  std::int32_t v = 0;
  float inward_x = 0;  ///< lattice spacings in the plane
  float inward_y = 0;
  float edge = 0;  ///< 1 in the colour of the outline
};

struct Mesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< of triangles; first those of the fill
  std::size_t fill_indices = 0;
  GridPoint low, high;  ///< smallest box around the body
};

Mesh mesh(const lattice::Shape& shape);

}  // namespace clca::render
