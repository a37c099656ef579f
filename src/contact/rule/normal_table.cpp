#include "contact/rule/normal_table.hpp"

#include <algorithm>

namespace clca::contact {

namespace {

/// The smallest parallelogram of lattice vectors around a shape.
struct Extent {
  lattice::Axial low;
  lattice::Axial high;
};

Extent extent(const lattice::Shape& shape) {
  Extent result = {shape.sites().front(), shape.sites().front()};
  for (const lattice::Axial site : shape.sites()) {
    result.low = {std::min(result.low.x, site.x), std::min(result.low.q, site.q)};
    result.high = {std::max(result.high.x, site.x), std::max(result.high.q, site.q)};
  }
  return result;
}

}  // namespace

void NormalTable::make(Table& table, const lattice::Shape& first, const lattice::Shape& second) {
  constexpr lattice::Axial kNext = {1, 1};
  const Extent one = extent(first);
  const Extent other = extent(second);
  table.low = one.low - other.high - kNext;
  const lattice::Axial size = one.high - other.low + kNext - table.low + kNext;
  table.columns = size.x;
  table.rows = size.q;
  table.normals.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.q),
                       kUnknown);
}

}  // namespace clca::contact
