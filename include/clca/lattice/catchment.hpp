#pragma once
// The sites that something at home there brings into the box as it moves.

#include "clca/lattice/lattice.hpp"

namespace clca::lattice {

/// From `first` up to but not including `end`.
struct Rows {
  int first = 0;
  int end = 0;
};

/// The sites that lie in the box after some number of steps, from `low` to `high`, in `direction`.
/// Nothing wraps around at home: where the box is periodic the columns are those of the box.
class Catchment {
 public:
  /// The sites of the box itself.
  explicit Catchment(const Lattice& lattice) : Catchment(lattice, Direction::up, 0, 0) {}
  Catchment(const Lattice& lattice, Direction direction, int low, int high);

  int first_column() const { return first_column_; }
  int end_column() const { return end_column_; }
  /// Those of a column; none where first >= end.
  Rows rows(int column) const;
  /// No column has rows beyond these.
  Rows all_rows() const;

  bool contains(Site site) const;

 private:
  /// Rows that the steps raise a site in `column` by.
  int rise(int column, int steps) const;

  Lattice lattice_;
  Axial step_;
  int low_;
  int high_;
  int first_column_;
  int end_column_;
};

}  // namespace clca::lattice
