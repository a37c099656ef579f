#include "clca/lattice/lattice.hpp"

#include <cmath>

#include "lattice/internal/require.hpp"

namespace clca::lattice {

namespace {
constexpr std::size_t kWordBits = 64;

std::size_t column_size(int rows) {
  const auto with_border = static_cast<std::size_t>(rows) + 2;
  return (with_border + kWordBits - 1) / kWordBits * kWordBits;
}
}  // namespace

Lattice::Lattice(int columns, int rows, bool periodic)
    : columns_(columns),
      rows_(rows),
      periodic_(periodic),
      column_size_(column_size(rows)),
      wrap_(static_cast<std::ptrdiff_t>(column_size_) * columns) {
  require(columns >= 1 && rows >= 1, "a lattice has at least one column and one row");
  require(!periodic || !is_odd(columns), "a periodic lattice has an even number of columns");
}

Lattice Lattice::covering(double width, double height, bool periodic) {
  constexpr double kMaxLength = 1 << 30;
  require(width > 0 && height > 0 && width / kColumnPitch <= kMaxLength && height <= kMaxLength,
          "a box has a positive width and height of less than 10^9");
  int columns = static_cast<int>(std::ceil(width / kColumnPitch));
  if (periodic && is_odd(columns)) {
    ++columns;
  }
  return {columns, static_cast<int>(std::ceil(height)), periodic};
}

Eigen::Vector2d Lattice::image_in_box(const Eigen::Vector2d& point) const {
  const double left = lower_left_corner().x();
  const double width = extent().x();
  const auto inside = [&](double x) { return x >= left && x < left + width; };
  if (!periodic_ || inside(point.x())) {
    return point;
  }
  const double x = point.x() - width * std::floor((point.x() - left) / width);
  return {inside(x) ? x : left, point.y()};  // rounding may lead to the right edge
}

IndexOffset Lattice::index_offset(Axial vector, bool odd_column) const {
  const Site from = {odd_column ? 1 : 0, 0};
  const Site to = from + vector;
  int columns = to.column - from.column;
  if (periodic_) {
    columns %= columns_;  // even, so that the row is the same; at() goes across the seam once
  }
  // As index() counts, the border comes first: odd columns are the first ones of their pairs.
  const int in_pair = odd_column ? 0 : 1;
  const int pairs = (in_pair + columns) >> 1;
  const auto linear =
      (pairs * static_cast<std::ptrdiff_t>(column_size_) + (to.row - from.row)) * kRowStride +
      (columns - 2 * pairs);
  require(std::in_range<std::int32_t>(linear),
          "a vector reaches too far in a lattice with so many rows");
  return {static_cast<std::int32_t>(linear), columns};
}

}  // namespace clca::lattice
