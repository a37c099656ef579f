#include <algorithm>

#include "render/polygon_painter.hpp"

namespace clca::render {

namespace {

std::uint32_t add_vertex(Mesh& mesh, GridPoint point, const Eigen::Vector2d& inward, float edge) {
  mesh.vertices.push_back(
      {point.u, point.v, static_cast<float>(inward.x()), static_cast<float>(inward.y()), edge});
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

void add_fill(Mesh& mesh, const Trapezoid& piece) {
  const auto corner = [&](GridPoint point) {
    return add_vertex(mesh, point, Eigen::Vector2d::Zero(), 0);
  };
  const std::uint32_t left_low = corner(piece.left_low);
  const std::uint32_t right_low = corner(piece.right_low);
  const std::uint32_t right_high = corner(piece.right_high);
  const std::uint32_t left_high = corner(piece.left_high);
  if (piece.right_low != piece.right_high) {
    add_triangle(mesh, left_low, right_low, right_high);
  }
  if (piece.left_low != piece.left_high) {
    add_triangle(mesh, left_low, right_high, left_high);
  }
}

Eigen::Vector2d inward_normal(GridPoint from, GridPoint to) {
  const Eigen::Vector2d along = (position(to) - position(from)).normalized();
  return {-along.y(), along.x()};
}

void add_outline(Mesh& mesh, const Outline& outline) {
  const std::size_t count = outline.size();
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d before = inward_normal(outline[(i + count - 1) % count], outline[i]);
    const Eigen::Vector2d after = inward_normal(outline[i], outline[(i + 1) % count]);
    const Eigen::Vector2d mitre = (before + after) / (1 + before.dot(after));
    add_vertex(mesh, outline[i], Eigen::Vector2d::Zero(), 1);
    add_vertex(mesh, outline[i], mitre, 1);
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = first + 2 * i;
    const std::uint32_t next = first + 2 * ((i + 1) % static_cast<std::uint32_t>(count));
    add_triangle(mesh, here, next, next + 1);
    add_triangle(mesh, here, next + 1, here + 1);
  }
}

}  // namespace

Mesh mesh(const lattice::Shape& shape) {
  Mesh result;
  for (const Trapezoid& piece : trapezoids(shape)) {
    add_fill(result, piece);
  }
  result.fill_indices = result.indices.size();
  for (const Outline& outline : outlines(shape)) {
    add_outline(result, outline);
  }
  result.low = result.high = {result.vertices.front().u, result.vertices.front().v};
  for (const MeshVertex& vertex : result.vertices) {
    result.low = {std::min(result.low.u, vertex.u), std::min(result.low.v, vertex.v)};
    result.high = {std::max(result.high.u, vertex.u), std::max(result.high.v, vertex.v)};
  }
  return result;
}

}  // namespace clca::render
