#include "clca/measure/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "measure/places.hpp"

namespace clca::measure {

namespace {

constexpr int kMaxCells = 1'000'000'000;

std::size_t count_of(double extent, double cell) {
  require(cell > 0 && extent / cell < double{kMaxCells},
          "the side of a cell must be positive, and not that small");
  return static_cast<std::size_t>(std::max(1.0, std::round(extent / cell)));
}

/// Adds the shares of a path from `from` to `to`, in cells, at which it crosses an edge.
void add_crossings(double from, double to, std::vector<double>& shares) {
  const auto [low, high] = std::minmax(from, to);
  const auto end = static_cast<std::int64_t>(std::ceil(high));
  for (auto edge = static_cast<std::int64_t>(std::floor(low)) + 1; edge < end; ++edge) {
    shares.push_back((static_cast<double>(edge) - from) / (to - from));
  }
}

}  // namespace

Grid::Grid(const lattice::Lattice& lattice, double cell)
    : low_(lattice::Lattice::lower_left_corner()),
      extents_(lattice.extent()),
      periodic_(lattice.periodic()),
      columns_(count_of(extents_.x(), cell)),
      rows_(count_of(extents_.y(), cell)) {
  require(columns_ < std::size_t{kMaxCells} / rows_, "the side of a cell is too small");
}

Eigen::Vector2d Grid::in_cells(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d counts(static_cast<double>(columns_), static_cast<double>(rows_));
  return (point - low_).cwiseQuotient(extents_).cwiseProduct(counts);
}

std::array<std::size_t, 2> Grid::cells_at(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d position = in_cells(point);
  const std::size_t row = nearest_part(part_at(position.y()), rows_);
  const auto cell = [&](double column) {
    const auto columns = static_cast<double>(columns_);
    if (periodic_) {
      column -= columns * std::floor(column / columns);
    }
    return row * columns_ + nearest_part(column, columns_);
  };
  return {cell(part_before(position.x())), cell(part_at(position.x()))};
}

std::vector<Grid::PathPart> Grid::path_parts(const Eigen::Vector2d& from,
                                             const Eigen::Vector2d& path) const {
  const Eigen::Vector2d begin = in_cells(from);
  const Eigen::Vector2d end = in_cells(from + path);
  std::vector<double> shares = {0, 1};
  add_crossings(begin.x(), end.x(), shares);
  add_crossings(begin.y(), end.y(), shares);
  std::ranges::sort(shares);
  std::vector<PathPart> parts;
  for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
    const double middle = (shares[i] + shares[i + 1]) / 2;
    share_out(from + middle * path, [&](std::size_t cell, double share) {
      parts.push_back({.cell = cell, .share = share * (shares[i + 1] - shares[i])});
    });
  }
  return parts;
}

Eigen::Vector2d Grid::cell_centre(std::size_t cell) const {
  const std::size_t row = cell / columns_;
  const std::size_t column = cell % columns_;
  const Eigen::Vector2d share((static_cast<double>(column) + 0.5) / static_cast<double>(columns_),
                              (static_cast<double>(row) + 0.5) / static_cast<double>(rows_));
  return low_ + extents_.cwiseProduct(share);
}

}  // namespace clca::measure
