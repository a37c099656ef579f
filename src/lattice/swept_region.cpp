#include "clca/lattice/swept_region.hpp"

#include <algorithm>

namespace clca::lattice {

SweptRegion::SweptRegion(const Lattice& lattice, Direction direction, int low, int high)
    : lattice_(lattice),
      step_(unit(direction)),
      low_(low),
      high_(high),
      first_column_(0),
      end_column_(lattice.columns()) {
  if (!lattice.periodic()) {
    first_column_ -= std::max(step_.x * low, step_.x * high);
    end_column_ -= std::min(step_.x * low, step_.x * high);
  }
}

int SweptRegion::rise(int column, int steps) const {
  return (Site{column, 0} + Axial{step_.x * steps, step_.q * steps}).row;
}

RowRange SweptRegion::rows(int column) const {
  int from = low_;
  int to = high_;
  if (!lattice_.periodic() && step_.x != 0) {
    // Steps after which the column is in the box.
    const auto [enter, leave] =
        std::minmax({-step_.x * column, step_.x * (lattice_.columns() - 1 - column)});
    from = std::max(from, enter);
    to = std::min(to, leave);
  }
  if (from > to) {
    return {};
  }
  // A step raises by at most one row, so that the rows of consecutive steps are contiguous.
  const auto [least, most] = std::minmax({rise(column, from), rise(column, to)});
  return {-most, lattice_.rows() - least};
}

RowRange SweptRegion::all_rows() const {
  // All columns of one parity rise alike.
  const auto [least, most] =
      std::minmax({rise(0, low_), rise(0, high_), rise(1, low_), rise(1, high_)});
  return {-most, lattice_.rows() - least};
}

bool SweptRegion::contains(Site site) const {
  if (site.column < first_column_ || site.column >= end_column_) {
    return false;
  }
  const RowRange inside = rows(site.column);
  return site.row >= inside.first && site.row < inside.end;
}

}  // namespace clca::lattice
