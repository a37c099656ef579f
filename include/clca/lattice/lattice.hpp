#pragma once
// The box of lattice sites: columns, rows, positions in the plane, indices in memory.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "clca/lattice/direction.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::lattice {

/// Distance of neighbouring columns in lattice spacings: sqrt(3)/2.
inline constexpr double kColumnPitch = 0.86602540378443864676;

/// A site by column and row. Odd columns are half a spacing higher.
struct Site {
  int column = 0;
  int row = 0;

  constexpr auto operator<=>(const Site&) const = default;
  CLCA_FIELDS(column, row);
};

constexpr bool is_odd(int column) {
  return (column & 1) != 0;
}

/// Twice the height of a site, in lattice spacings: an integer.
constexpr int doubled_height(Site site) {
  return 2 * site.row + (is_odd(site.column) ? 1 : 0);
}

/// Cartesian position of a site in lattice spacings, relative to the lower left site.
inline Eigen::Vector2d position(Site site) {
  return {kColumnPitch * site.column, 0.5 * doubled_height(site)};
}

/// Cartesian form of a lattice vector in lattice spacings.
inline Eigen::Vector2d position(Axial vector) {
  return {kColumnPitch * vector.x, vector.q + 0.5 * vector.x};
}

/// The site reached from `site` by `vector`.
constexpr Site operator+(Site site, Axial vector) {
  const int column = site.column + vector.x;
  return {column, site.row + vector.q + (column >> 1) - (site.column >> 1)};
}

/// The lattice vector from `from` to `to`.
constexpr Axial operator-(Site to, Site from) {
  return {to.column - from.column, (to.row - (to.column >> 1)) - (from.row - (from.column >> 1))};
}

/// From a reference site to another site. Valid for reference columns of one parity only.
struct IndexOffset {
  std::int32_t index = 0;   ///< difference of the indices
  std::int32_t column = 0;  ///< difference of the columns

  bool operator==(const IndexOffset&) const = default;
};

/// A box of `columns` x `rows` sites, with a border one site wide so that every neighbour has an
/// index.
/// Memory interleaves two neighbouring columns: sites close in the plane are close in memory.
class Lattice {
 public:
  /// Throws std::invalid_argument unless both are positive, and even columns if periodic.
  Lattice(int columns, int rows, bool periodic);

  /// The smallest lattice whose sites cover width x height (lattice spacings). Throws
  /// std::invalid_argument unless both are positive and less than 10^9.
  static Lattice covering(double width, double height, bool periodic);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool periodic() const { return periodic_; }
  /// Number of indices, border included.
  std::size_t index_count() const {
    return (static_cast<std::size_t>(columns_) + 3) / 2 * 2 * column_size_;
  }

  bool contains(Site site) const {
    return site.row >= 0 && site.row < rows_ &&
           (periodic_ || (site.column >= 0 && site.column < columns_));
  }

  /// Index difference between a row and the next.
  static constexpr int kRowStride = 2;

  /// Index of a site of the box or its border.
  std::size_t index(Site site) const {
    const auto column = static_cast<std::size_t>(wrapped(site.column)) + 1;
    const auto row = static_cast<std::size_t>(site.row) + 1;
    return (column / 2 * column_size_ + row) * std::size_t{kRowStride} + column % 2;
  }

  /// The site with an index; also for rows beyond the border.
  Site site(std::size_t index) const {
    const std::size_t row = index / std::size_t{kRowStride};  // counted through pairs of columns
    return {static_cast<int>(row / column_size_ * 2 + index % 2) - 1,
            static_cast<int>(row % column_size_) - 1};
  }

  /// The column that a periodic box has in place of this one; in another box the column itself.
  int wrapped(int column) const {
    if (!periodic_) {
      return column;
    }
    const int remainder = column % columns_;
    return remainder < 0 ? remainder + columns_ : remainder;
  }

  /// The vector between two sites, the shorter way round a periodic box.
  Axial shortest_vector(Site from, Site to) const {
    if (periodic_) {
      const int apart = wrapped(to.column - from.column);
      to.column = from.column + (2 * apart > columns_ ? apart - columns_ : apart);
    }
    return to - from;
  }

  /// Lower left corner and size of the box in the plane, in lattice spacings: every site counts
  /// with its whole cell. A periodic box repeats at its width.
  static Eigen::Vector2d lower_left_corner() { return {-0.5 * kColumnPitch, -0.5}; }
  Eigen::Vector2d extent() const { return {kColumnPitch * columns_, rows_ + 0.5}; }
  /// The image of a point in a periodic box, from its left edge up to its right one; in another box
  /// the point itself. All that is written, drawn or reported of a periodic box goes through here.
  Eigen::Vector2d image_in_box(const Eigen::Vector2d& point) const;

  /// Offset of `vector` from an odd or even column; std::invalid_argument beyond 2^31 indices.
  IndexOffset index_offset(Axial vector, bool odd_column) const;

  /// Index of the site at `offset` from the site with index `base` in the (wrapped) `column`.
  std::size_t shifted_index(std::size_t base, int column, IndexOffset offset) const {
    auto result = static_cast<std::ptrdiff_t>(base) + offset.index;
    if (periodic_) {
      const int target = column + offset.column;
      if (target < 0) {
        result += wrap_;
      } else if (target >= columns_) {
        result -= wrap_;
      }
    }
    return static_cast<std::size_t>(result);
  }

  bool operator==(const Lattice&) const = default;

 private:
  int columns_;
  int rows_;
  bool periodic_;
  std::size_t column_size_;  // indices, a multiple of 64
  std::ptrdiff_t wrap_;      // index difference of a column and its periodic image
};

}  // namespace clca::lattice
