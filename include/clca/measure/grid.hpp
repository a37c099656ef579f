#pragma once
// Cells in which fields are measured.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "clca/lattice/lattice.hpp"

namespace clca::measure {

/// Calls visit(part, share) for two parts, half to each, or for the one that both are.
template <class Visit>
void share_out(std::size_t before, std::size_t after, const Visit& visit) {
  if (before == after) {
    visit(after, 1.0);
  } else {
    visit(before, 0.5);
    visit(after, 0.5);
  }
}

/// Equal cells that fill the box, as close to squares of the requested side as whole numbers allow.
/// The box extends half a spacing (across: half a column) beyond its outermost sites.
/// Cells are numbered along the rows from the lower left.
class Grid {
 public:
  /// `cell`: the requested side in lattice spacings. Throws std::invalid_argument unless it is
  /// positive and gives fewer than 10^9 cells.
  Grid(const lattice::Lattice& lattice, double cell);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  std::size_t size() const { return columns_ * rows_; }

  /// Area of a cell, in squared lattice spacings.
  double cell_area() const { return extents_.prod() / static_cast<double>(size()); }

  /// Index of the cell that contains a point (lattice spacings); wraps at a periodic boundary. An
  /// edge belongs to the cell right of it or above it, whatever the rounding of the point.
  std::size_t cell_at(const Eigen::Vector2d& point) const { return cells_at(point)[1]; }
  /// The cells left and right of the edge that a point is on; else its cell twice.
  std::array<std::size_t, 2> cells_at(const Eigen::Vector2d& point) const;
  /// Calls visit(cell, share) for these cells, half to each: mirrored beds have mirrored fields.
  template <class Visit>
  void share_out(const Eigen::Vector2d& point, const Visit& visit) const {
    const auto [left, right] = cells_at(point);
    measure::share_out(left, right, visit);
  }
  /// Centre of a cell, in lattice spacings.
  Eigen::Vector2d cell_centre(std::size_t cell) const;

  struct PathPart {
    std::size_t cell = 0;
    double share = 0;  ///< of the length of the path
  };
  /// Divides the straight path from `from` to `from + path` (lattice spacings) at edges of cells.
  std::vector<PathPart> path_parts(const Eigen::Vector2d& from, const Eigen::Vector2d& path) const;

 private:
  Eigen::Vector2d in_cells(const Eigen::Vector2d& point) const;  // from the corner of the box

  Eigen::Vector2d low_;      // corner of the box
  Eigen::Vector2d extents_;  // of the box
  bool periodic_;
  std::size_t columns_;
  std::size_t rows_;
};

}  // namespace clca::measure
