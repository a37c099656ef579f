#pragma once
// Values by the relative position of two shapes.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "clca/lattice/shape.hpp"

namespace clca::grains {

/// A value for each vector from the reference site of a shape to that of another at which they
/// overlap or touch, and for some around these.
template <class Value>
class ApartTable {
 public:
  ApartTable() = default;  ///< of nothing
  ApartTable(const lattice::Shape& first, const lattice::Shape& second, Value value) {
    const auto [first_low, first_high] = extent(first);
    const auto [second_low, second_high] = extent(second);
    constexpr lattice::Axial kNext = {1, 1};
    low_ = first_low - second_high - kNext;
    size_ = first_high - second_low + kNext - low_ + kNext;
    values_.assign(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.q), value);
  }

  bool is_empty() const { return values_.empty(); }
  /// Columns from low_column() up to the one before end_column().
  int low_column() const { return low_.x; }
  int end_column() const { return low_.x + size_.x; }
  /// Null for vectors that are not in the table.
  const Value* find(lattice::Axial apart) const {
    const lattice::Axial at = apart - low_;
    const bool inside = at.x >= 0 && at.q >= 0 && at.x < size_.x && at.q < size_.q;
    return inside ? &values_[static_cast<std::size_t>(at.x) * static_cast<std::size_t>(size_.q) +
                             static_cast<std::size_t>(at.q)]
                  : nullptr;
  }
  Value* find(lattice::Axial apart) {
    return const_cast<Value*>(static_cast<const ApartTable&>(*this).find(apart));
  }
  /// Calls `visit` with each vector.
  template <class Visit>
  void for_each(Visit visit) const {
    for (int x = 0; x < size_.x; ++x) {
      for (int q = 0; q < size_.q; ++q) {
        visit(low_ + lattice::Axial{x, q});
      }
    }
  }

 private:
  struct Extent {
    lattice::Axial low;
    lattice::Axial high;
  };
  static Extent extent(const lattice::Shape& shape) {
    Extent result = {shape.sites().front(), shape.sites().front()};
    for (const lattice::Axial site : shape.sites()) {
      result.low = {std::min(result.low.x, site.x), std::min(result.low.q, site.q)};
      result.high = {std::max(result.high.x, site.x), std::max(result.high.q, site.q)};
    }
    return result;
  }

  lattice::Axial low_;
  lattice::Axial size_;
  std::vector<Value> values_;
};

}  // namespace clca::grains
