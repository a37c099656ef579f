#pragma once
// The box of lattice sites: columns, rows, their places in the plane and in memory.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "clca/fields/fields.hpp"
#include "clca/lattice/direction.hpp"

namespace clca::lattice {

/// Distance of neighbouring columns in lattice spacings: sqrt(3)/2.
inline constexpr double kColumnPitch = 0.86602540378443864676;

/// A site by column and by row within the column. Odd columns stand half a spacing higher.
struct Site {
  int column = 0;
  int row = 0;

  constexpr auto operator<=>(const Site&) const = default;
  static constexpr auto fields() {
    return std::make_tuple(fields::field("column", &Site::column),
                           fields::field("row", &Site::row));
  }
};

constexpr bool is_odd(int column) {
  return (column & 1) != 0;
}

/// Twice the height of a site, in lattice spacings: an integer.
constexpr int doubled_height(Site site) {
  return 2 * site.row + (is_odd(site.column) ? 1 : 0);
}

/// Cartesian place of a site in lattice spacings from the lower left site.
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

/// Where a site of a shape lies in memory, seen from the site of its particle.
/// Holds for reference columns of one parity only.
struct Offset {
  std::int32_t linear = 0;
  std::int32_t column = 0;

  bool operator==(const Offset&) const = default;
};

/// A box of `columns` x `rows` sites with a border one site wide around it, so that a look one
/// step outside is always valid. Memory runs up two neighbouring columns at once, so that what is
/// near each other in the plane is so in memory, and steps still depend on the parity only.
class Lattice {
 public:
  /// Throws std::invalid_argument unless both are positive and a periodic box has an even number
  /// of columns.
  Lattice(int columns, int rows, bool periodic);

  /// The smallest lattice whose sites cover width x height (lattice spacings). Throws
  /// std::invalid_argument unless both are positive and less than 10^9.
  static Lattice covering(double width, double height, bool periodic);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool periodic() const { return periodic_; }
  /// Number of places in memory, border included.
  std::size_t memory_size() const {
    return (static_cast<std::size_t>(columns_) + 3) / 2 * 2 * column_size_;
  }

  bool contains(Site site) const {
    return site.row >= 0 && site.row < rows_ &&
           (periodic_ || (site.column >= 0 && site.column < columns_));
  }

  /// Places from a row to the next.
  static constexpr int kRowPitch = 2;

  /// Place in memory of a site of the box or its border.
  std::size_t index(Site site) const {
    const auto column = static_cast<std::size_t>(wrapped(site.column)) + 1;
    const auto row = static_cast<std::size_t>(site.row) + 1;
    return (column / 2 * column_size_ + row) * std::size_t{kRowPitch} + column % 2;
  }

  /// The site at a place in memory (rows beyond the border included).
  Site site(std::size_t index) const {
    const std::size_t row =
        index / std::size_t{kRowPitch};  // those of all pairs of columns one on the other
    return {static_cast<int>(row / column_size_ * 2 + index % 2) - 1,
            static_cast<int>(row % column_size_) - 1};
  }

  int wrapped(int column) const {
    if (!periodic_) {
      return column;
    }
    const int remainder = column % columns_;
    return remainder < 0 ? remainder + columns_ : remainder;
  }

  /// Place and size in the plane of the union of the bodies of all sites, in lattice spacings: the
  /// lower left corner. A periodic box repeats at its width.
  static Eigen::Vector2d corner() { return {-0.5 * kColumnPitch, -0.5}; }
  Eigen::Vector2d size() const { return {kColumnPitch * columns_, rows_ + 0.5}; }
  /// How many widths of a periodic box a point lies to the right of the box; 0 where it is not.
  int image(double x) const;

  /// Offset of `vector` from a site in an odd or even column.
  Offset offset(Axial vector, bool odd_column) const;

  /// Place in memory of `offset` from the site at `base` in the (wrapped) `column`.
  std::size_t at(std::size_t base, int column, Offset offset) const {
    auto place = static_cast<std::ptrdiff_t>(base) + offset.linear;
    if (periodic_) {
      const int target = column + offset.column;
      if (target < 0) {
        place += wrap_;
      } else if (target >= columns_) {
        place -= wrap_;
      }
    }
    return static_cast<std::size_t>(place);
  }

  bool operator==(const Lattice&) const = default;

 private:
  int columns_;
  int rows_;
  bool periodic_;
  std::size_t column_size_;  // places, a multiple of 64
  std::ptrdiff_t wrap_;      // places between a column and its periodic image
};

}  // namespace clca::lattice
