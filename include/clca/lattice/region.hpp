#pragma once
// Rectangles, straight walls and pictures as sets of sites, also where a moving wall brings them.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "clca/lattice/lattice.hpp"

namespace clca::lattice {

/// `value` rounded down, from `low` to `high`.
inline int clamped_floor(double value, int low, int high) {
  const double whole = std::floor(value);
  return static_cast<int>(std::clamp(whole, static_cast<double>(low), static_cast<double>(high)));
}

/// Rows of a column, without `end_row`.
struct RowRange {
  int first_row = 0;
  int end_row = 0;
};

/// The sites that are in the box after k steps in `direction`, for some k from `low` to `high`.
/// Sites are not wrapped: in a periodic box the columns are those of the box.
class SweptRegion {
 public:
  /// The sites of the box.
  explicit SweptRegion(const Lattice& lattice) : SweptRegion(lattice, Direction::up, 0, 0) {}
  SweptRegion(const Lattice& lattice, Direction direction, int low, int high);

  int first_column() const { return first_column_; }
  int end_column() const { return end_column_; }
  /// Rows of a column; none if first_row >= end_row.
  RowRange rows(int column) const;
  /// A range that contains the rows of every column.
  RowRange enclosing_rows() const;

  bool contains(Site site) const;

 private:
  /// Number of rows by which the steps raise a site in `column`.
  int rise(int column, int steps) const;

  Lattice lattice_;
  Axial step_;
  int low_;
  int high_;
  int first_column_;
  int end_column_;
};

/// Whether `test` holds for a site of the region: tries those in the columns from `left` to `right`
/// and some beside them, and in each column those between the pairs of heights in `parts(column)`,
/// which are in order and further than three apart, and some beside them, until it holds. A pair
/// whose first height is above its second has no sites. All lengths in lattice spacings.
template <class Parts, class Test>
bool any_site(const SweptRegion& swept_region, double left, double right, const Parts& parts,
              const Test& test) {
  const int first = swept_region.first_column();
  const int end = swept_region.end_column();
  const int last_column = clamped_floor(right / kColumnPitch + 2, first, end);
  for (int column = clamped_floor(left / kColumnPitch - 1, first, end); column < last_column;
       ++column) {
    const RowRange rows = swept_region.rows(column);
    for (const auto& [bottom, top] : parts(column)) {
      const int last_row = clamped_floor(top + 2, rows.first_row, rows.end_row);
      for (int row = clamped_floor(bottom - 1, rows.first_row, rows.end_row); row < last_row;
           ++row) {
        if (test(Site{column, row})) {
          return true;
        }
      }
    }
  }
  return false;
}

/// A rectangle in lattice spacings. Left and bottom edges belong to it, right and top edges do not.
struct Rectangle {
  double left = 0;
  double bottom = 0;
  double right = 0;
  double top = 0;

  bool contains(const Eigen::Vector2d& point) const {
    return point.x() >= left && point.x() < right && point.y() >= bottom && point.y() < top;
  }
  bool operator==(const Rectangle&) const = default;
};

/// Throws std::invalid_argument when an edge is not a number.
void check_valid(const Rectangle& rectangle);

/// A straight wall from `from` to `to`, `thickness` wide (all in lattice spacings).
struct Segment {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  double thickness = 1;

  bool operator==(const Segment& other) const {
    return from == other.from && to == other.to && thickness == other.thickness;
  }
};

/// Pixels of equal size that cover a rectangle.
struct Picture {
  Rectangle box;  ///< what the pixels cover
  /// From the top, all of one length, at least one character; those of a wall: kDark and kLight.
  std::vector<std::string> rows;

  static constexpr char kDark = '#';
  static constexpr char kLight = '.';

  bool operator==(const Picture&) const = default;
};

/// A rectangle that contains all sites of a rectangle, a straight wall or a picture.
inline Rectangle bounding_rectangle(const Rectangle& rectangle) {
  return rectangle;
}
Rectangle bounding_rectangle(const Segment& segment);
inline Rectangle bounding_rectangle(const Picture& picture) {
  return picture.box;
}

/// Whether `test` holds for a site of the region inside `rectangle`: tries them column by column
/// from the left, upwards, until it does.
template <class Test>
bool any_site(const SweptRegion& swept_region, const Rectangle& rectangle, const Test& test) {
  const std::array part = {std::pair(rectangle.bottom, rectangle.top)};
  return any_site(
      swept_region, rectangle.left, rectangle.right, [&](int /*column*/) { return part; },
      [&](Site site) { return rectangle.contains(position(site)) && test(site); });
}

/// The sites of the region inside `rectangle`, from the left, upwards. Throws as check_valid().
std::vector<Site> sites_in(const SweptRegion& swept_region, const Rectangle& rectangle);
inline std::vector<Site> sites_in(const Lattice& lattice, const Rectangle& rectangle) {
  return sites_in(SweptRegion(lattice), rectangle);
}

/// The sites within half the thickness of the segment, and always a connected chain along it, so
/// that nothing passes through. Sorted.
/// Throws std::invalid_argument unless nearest_site takes the ends and thickness >= 0.
std::vector<Site> sites_along(const SweptRegion& swept_region, const Segment& segment);
inline std::vector<Site> sites_along(const Lattice& lattice, const Segment& segment) {
  return sites_along(SweptRegion(lattice), segment);
}

/// The pixel at a point of the box of the picture. Throws std::invalid_argument if there are none.
char pixel_at(const Picture& picture, const Eigen::Vector2d& point);

/// The sites of the region in the box that lie on a dark pixel, column by column from the left,
/// upwards. Throws as check_valid(), and std::invalid_argument if there are no pixels.
std::vector<Site> sites_in(const SweptRegion& swept_region, const Picture& picture);

/// Whether sites_in() is empty.
bool holds_no_site(const Lattice& lattice, const Picture& picture);

/// The site nearest to a point in lattice spacings. Throws std::invalid_argument beyond 10^8.
Site nearest_site(const Eigen::Vector2d& point);

}  // namespace clca::lattice
