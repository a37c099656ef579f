#pragma once
// The relative position of two grains, and values by it.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "clca/lattice/lattice.hpp"
#include "clca/lattice/shape.hpp"

namespace clca::grains {

/// The vector between two sites, the shorter way round a periodic box.
inline lattice::Axial nearest_vector(const lattice::Lattice& lattice, lattice::Site from,
                                     lattice::Site to) {
  if (lattice.periodic()) {
    const int columns = lattice.columns();
    const int apart = lattice.wrapped(to.column - from.column);
    to.column = from.column + (2 * apart > columns ? apart - columns : apart);
  }
  return to - from;
}

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
