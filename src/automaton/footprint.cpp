#include "clca/automaton/footprint.hpp"

#include <algorithm>
#include <iterator>

namespace clca::automaton {

namespace {

using lattice::Axial;
using lattice::Direction;

std::vector<lattice::Offset> offsets(const lattice::Lattice& lattice,
                                     const std::vector<Axial>& sites, bool odd_column) {
  std::vector<lattice::Offset> result;
  result.reserve(sites.size());
  for (const Axial site : sites) {
    result.push_back(lattice.offset(site, odd_column));
  }
  return result;
}

/// Sites from which a candidate move leads into one of `vacated`. Those of `left_out` are dropped.
std::vector<Axial> upstream(const std::vector<Axial>& vacated,
                            std::span<const Direction> candidates,
                            const std::vector<Axial>& left_out) {
  std::vector<Axial> result;
  for (const Axial site : vacated) {
    for (const Direction direction : candidates) {
      result.push_back(site - unit(direction));
    }
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](Axial site) {
    return std::binary_search(left_out.begin(), left_out.end(), site);
  });
  return result;
}

Footprint make_footprint(const State& state, const lattice::Shape& shape, bool odd_column) {
  const std::span<const Direction> candidates = candidate_directions(state.rules);
  Footprint footprint;
  footprint.body = offsets(state.lattice, shape.sites(), odd_column);
  for (const Direction direction : lattice::kDirections) {
    const std::size_t d = index_of(direction);
    const std::vector<Axial> lead = shape.lead(direction);
    const std::vector<Axial> trail = shape.trail(direction);
    std::vector<Axial> swept;
    std::merge(shape.sites().begin(), shape.sites().end(), lead.begin(), lead.end(),
               std::back_inserter(swept));
    footprint.lead[d] = offsets(state.lattice, lead, odd_column);
    footprint.trail[d] = offsets(state.lattice, trail, odd_column);
    footprint.wake[d] = offsets(state.lattice, upstream(trail, candidates, swept), odd_column);
  }
  return footprint;
}

}  // namespace

std::span<const Direction> candidate_directions(const Rules& rules) {
  static constexpr auto kOrdered = [] {
    std::array<std::array<Direction, lattice::kDirectionCount>, lattice::kDirectionCount> table{};
    for (const Direction gravity : lattice::kDirections) {
      constexpr std::array<int, lattice::kDirectionCount> kTurns = {0, 1, -1, 2, -2, 3};
      for (std::size_t i = 0; i < kTurns.size(); ++i) {
        table[index_of(gravity)][i] = rotated(gravity, kTurns[i]);
      }
    }
    return table;
  }();
  const auto& ordered = kOrdered[index_of(rules.gravity)];
  return {ordered.data(), rules.candidates == Candidates::all ? ordered.size() : 3};
}

FootprintTable::FootprintTable(const State& state) {
  table_.reserve(2 * state.kinds.size());
  for (const Kind& kind : state.kinds) {
    table_.push_back(make_footprint(state, kind.shape, false));
    table_.push_back(make_footprint(state, kind.shape, true));
  }
}

}  // namespace clca::automaton
