#include "clca/measure/grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace clca::measure {

namespace {

constexpr int kMaxCells = 1'000'000'000;

std::size_t count_of(double extent, double cell) {
  if (!(cell > 0 && extent / cell < double{kMaxCells})) {
    throw std::invalid_argument("the side of a cell must be positive, and not that small");
  }
  return static_cast<std::size_t>(std::max(1.0, std::round(extent / cell)));
}

/// Which of `count` equal parts of the unit interval contains `share`; the nearest if none.
std::size_t part_of(double share, std::size_t count) {
  const double last = static_cast<double>(count) - 1;
  return static_cast<std::size_t>(
      std::clamp(std::floor(share * static_cast<double>(count)), 0.0, last));
}

}  // namespace

// Odd columns stand half a spacing higher than even ones.
Grid::Grid(const lattice::Lattice& lattice, double cell)
    : low_(-lattice::kColumnPitch / 2, -0.5),
      extents_(lattice::kColumnPitch * lattice.columns(),
               lattice.rows() + (lattice.columns() > 1 ? 0.5 : 0.0)),
      periodic_(lattice.periodic()),
      columns_(count_of(extents_.x(), cell)),
      rows_(count_of(extents_.y(), cell)) {
  if (columns_ >= std::size_t{kMaxCells} / rows_) {
    throw std::invalid_argument("the side of a cell is too small");
  }
}

std::size_t Grid::index(const Eigen::Vector2d& point) const {
  Eigen::Vector2d share = (point - low_).cwiseQuotient(extents_);
  if (periodic_) {
    share.x() -= std::floor(share.x());
  }
  return part_of(share.y(), rows_) * columns_ + part_of(share.x(), columns_);
}

Eigen::Vector2d Grid::centre(std::size_t index) const {
  const std::size_t row = index / columns_;
  const std::size_t column = index % columns_;
  const Eigen::Vector2d share((static_cast<double>(column) + 0.5) / static_cast<double>(columns_),
                              (static_cast<double>(row) + 0.5) / static_cast<double>(rows_));
  return low_ + extents_.cwiseProduct(share);
}

}  // namespace clca::measure
