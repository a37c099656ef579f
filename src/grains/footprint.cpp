#include "grains/internal/footprint.hpp"

#include <set>

namespace clca::grains {

std::vector<lattice::Offset> offsets(const lattice::Lattice& lattice,
                                     const std::vector<lattice::Axial>& sites, bool odd_column) {
  std::vector<lattice::Offset> result;
  result.reserve(sites.size());
  for (const lattice::Axial site : sites) {
    result.push_back(lattice.offset(site, odd_column));
  }
  return result;
}

namespace {

Footprint make_footprint(const lattice::Lattice& lattice, const lattice::Shape& shape,
                         bool odd_column) {
  Footprint footprint;
  footprint.body = offsets(lattice, shape.sites(), odd_column);
  std::set<lattice::Axial> ring;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::size_t d = index_of(direction);
    const std::vector<lattice::Axial> lead = shape.lead(direction);
    ring.insert(lead.begin(), lead.end());
    footprint.lead[d] = offsets(lattice, lead, odd_column);
    footprint.trail[d] = offsets(lattice, shape.trail(direction), odd_column);
  }
  footprint.ring = offsets(lattice, {ring.begin(), ring.end()}, odd_column);
  return footprint;
}

}  // namespace

FootprintTable::FootprintTable(const State& state) {
  table_.reserve(2 * state.kinds.size());
  for (const Kind& kind : state.kinds) {
    table_.push_back(make_footprint(state.lattice, kind.shape, false));
    table_.push_back(make_footprint(state.lattice, kind.shape, true));
  }
}

}  // namespace clca::grains
