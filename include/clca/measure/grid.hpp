#pragma once
// Cells in which fields are measured.

#include <Eigen/Core>
#include <cstddef>

#include "clca/lattice/lattice.hpp"

namespace clca::measure {

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

  /// In squared lattice spacings.
  double cell_area() const { return extents_.prod() / static_cast<double>(size()); }

  /// Index of the cell that contains a point (lattice spacings); wraps at a periodic boundary.
  std::size_t index(const Eigen::Vector2d& point) const;
  /// Centre of a cell, in lattice spacings.
  Eigen::Vector2d centre(std::size_t index) const;

 private:
  Eigen::Vector2d low_;      // corner of the box
  Eigen::Vector2d extents_;  // of the box
  bool periodic_;
  std::size_t columns_;
  std::size_t rows_;
};

}  // namespace clca::measure
