#pragma once
// The sites that a moving wall brings into the box.

#include "clca/lattice/lattice.hpp"

namespace clca::lattice {

/// Rows from `first` up to but not including `end`.
struct RowRange {
  int first = 0;
  int end = 0;
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
  /// Rows of a column; none if first >= end.
  RowRange rows(int column) const;
  /// A range that contains the rows of every column.
  RowRange all_rows() const;

  bool contains(Site site) const;

 private:
  /// By how many rows the steps raise a site in `column`.
  int rise(int column, int steps) const;

  Lattice lattice_;
  Axial step_;
  int low_;
  int high_;
  int first_column_;
  int end_column_;
};

}  // namespace clca::lattice
