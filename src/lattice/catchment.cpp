#include "clca/lattice/catchment.hpp"

#include <algorithm>

namespace clca::lattice {

Catchment::Catchment(const Lattice& lattice, Direction direction, int low, int high)
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

int Catchment::rise(int column, int steps) const {
  return (Site{column, 0} + Axial{step_.x * steps, step_.q * steps}).row;
}

Rows Catchment::rows(int column) const {
  int from = low_;
  int to = high_;
  if (!lattice_.periodic() && step_.x != 0) {
    // Steps after which the column is one of the box.
    const auto [enter, leave] =
        std::minmax({-step_.x * column, step_.x * (lattice_.columns() - 1 - column)});
    from = std::max(from, enter);
    to = std::min(to, leave);
  }
  if (from > to) {
    return {};
  }
  // Each step raises by one row at most, so that the rows of one step follow those of the last.
  const auto [least, most] = std::minmax({rise(column, from), rise(column, to)});
  return {-most, lattice_.rows() - least};
}

Rows Catchment::all_rows() const {
  // All columns of one parity are raised alike.
  const auto [least, most] =
      std::minmax({rise(0, low_), rise(0, high_), rise(1, low_), rise(1, high_)});
  return {-most, lattice_.rows() - least};
}

bool Catchment::contains(Site site) const {
  if (site.column < first_column_ || site.column >= end_column_) {
    return false;
  }
  const Rows inside = rows(site.column);
  return site.row >= inside.first && site.row < inside.end;
}

}  // namespace clca::lattice
