#pragma once
// Cells in which fields are measured.

#include <Eigen/Core>
#include <cstddef>

#include "clca/lattice/lattice.hpp"

namespace clca::measure {

/// A whole number of equal cells that fill the box, each as near to a square of the wished side as
/// that allows. The box reaches half a spacing (across: half a column) beyond its outermost sites.
/// Rows of cells count from the bottom, columns from the left; the index runs along the rows.
class Grid {
 public:
  /// `cell`: the wished side in lattice spacings. Throws std::invalid_argument unless it is greater
  /// than 0 and leaves less than 10^9 cells.
  Grid(const lattice::Lattice& lattice, double cell);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  std::size_t size() const { return columns_ * rows_; }

  /// In squared lattice spacings.
  double cell_area() const { return extents_.prod() / static_cast<double>(size()); }

  /// Of the cell that holds a point (lattice spacings); across a periodic seam it runs on.
  std::size_t index(const Eigen::Vector2d& point) const;
  /// Of a cell, in lattice spacings.
  Eigen::Vector2d centre(std::size_t index) const;

 private:
  Eigen::Vector2d low_;      // corner of the box
  Eigen::Vector2d extents_;  // of the box
  bool periodic_;
  std::size_t columns_;
  std::size_t rows_;
};

}  // namespace clca::measure
