#include "automaton/engine/windowed_footprint.hpp"

#include <algorithm>
#include <iterator>

#include "grains/internal/bitboard.hpp"

namespace clca::automaton {

namespace {

using lattice::Axial;
using lattice::Direction;

/// Bounding box of sites relative to the reference site.
struct SiteExtent {
  lattice::Site low;
  lattice::Site high;

  bool fits_a_window() const {
    return high.column - low.column < grains::kWindow && high.row - low.row < grains::kWindow;
  }
};

lattice::Site seen_from(bool odd_column, Axial site) {
  const lattice::Site from = {odd_column ? 1 : 0, 0};
  const lattice::Site to = from + site;
  return {to.column - from.column, to.row};
}

SiteExtent extent_of(const std::vector<Axial>& sites, bool odd_column) {
  SiteExtent extent;
  for (const Axial site : sites) {
    const lattice::Site at = seen_from(odd_column, site);
    extent.low = {std::min(extent.low.column, at.column), std::min(extent.low.row, at.row)};
    extent.high = {std::max(extent.high.column, at.column), std::max(extent.high.row, at.row)};
  }
  return extent;
}

/// The masks of the adjacent windows from `low` on that contain sites.
std::vector<WindowMask> window_masks(const std::vector<Axial>& sites, bool odd_column,
                                     lattice::Site low) {
  std::vector<WindowMask> result;
  for (const Axial site : sites) {
    const lattice::Site at = seen_from(odd_column, site);
    const int column = (at.column - low.column) / grains::kWindow * grains::kWindow + low.column;
    const int row = (at.row - low.row) / grains::kWindow * grains::kWindow + low.row;
    auto mask = std::ranges::find_if(result, [&](const WindowMask& window) {
      return window.column == column && window.row == row;
    });
    if (mask == result.end()) {
      mask = result.insert(mask, {.column = column, .row = row, .sites = 0});
    }
    const int bit = at.column - column + grains::kWindow * (at.row - row);
    mask->sites |= std::uint64_t{1} << static_cast<unsigned>(bit);
  }
  return result;
}

/// Sites from which a candidate move leads into one of `vacated`, except those of `left_out`.
std::vector<Axial> upstream(const std::vector<Axial>& vacated,
                            std::span<const Direction> candidates,
                            const std::vector<Axial>& left_out) {
  std::vector<Axial> result;
  for (const Axial site : vacated) {
    for (const Direction direction : candidates) {
      result.push_back(site - unit(direction));
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](Axial site) {
    return std::binary_search(left_out.begin(), left_out.end(), site);
  });
  return result;
}

std::vector<Axial> merged(const std::vector<Axial>& first, const std::vector<Axial>& second) {
  std::vector<Axial> both;
  std::merge(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(both));
  return both;
}

std::vector<Exchanges> exchanges(const std::vector<lattice::Offset>& lead,
                                 const std::vector<lattice::Offset>& trail) {
  std::vector<Exchanges> result((lead.size() + kExchanges - 1) / kExchanges);
  for (std::size_t i = 0; i < kExchanges * result.size(); ++i) {
    const std::size_t site = i % lead.size();
    result[i / kExchanges][i % kExchanges] = {lead[site].linear, trail[site].linear};
  }
  return result;
}

WindowedFootprint make_footprint(const grains::Footprint& plain, const lattice::Lattice& lattice,
                                 const lattice::Shape& shape, std::span<const Direction> candidates,
                                 bool odd_column) {
  WindowedFootprint::PerDirection<Axial> wake;
  std::vector<Axial> all = shape.sites();
  for (const Direction direction : lattice::kDirections) {
    const std::vector<Axial> swept = merged(shape.sites(), shape.lead(direction));
    wake[index_of(direction)] = upstream(shape.trail(direction), candidates, swept);
    all = merged(merged(all, swept), wake[index_of(direction)]);
  }
  const SiteExtent extent = extent_of(all, odd_column);
  WindowedFootprint footprint(plain);
  footprint.one_window = extent.fits_a_window();
  footprint.corner = extent.low;
  for (const Direction direction : lattice::kDirections) {
    const std::size_t d = index_of(direction);
    const std::vector<Axial> lead = shape.lead(direction);
    footprint.exchanges[d] = exchanges(footprint.lead[d], footprint.trail[d]);
    footprint.wake[d] = grains::offsets(lattice, wake[d], odd_column);
    footprint.lead_masks[d] = window_masks(lead, odd_column, extent.low);
    footprint.swapped_masks[d] =
        window_masks(merged(lead, shape.trail(direction)), odd_column, extent.low);
    if (footprint.one_window) {
      const std::vector<WindowMask> woken = window_masks(wake[d], odd_column, extent.low);
      footprint.windows[d] = {.lead = footprint.lead_masks[d].front().sites,
                              .swapped = footprint.swapped_masks[d].front().sites,
                              .wake = woken.empty() ? 0 : woken.front().sites};
    }
  }
  return footprint;
}

}  // namespace

WindowedFootprints::WindowedFootprints(const grains::State& state,
                                       std::span<const Direction> candidates) {
  const grains::FootprintTable plain(state);
  for (std::size_t number = 0; number < state.kinds.size(); ++number) {
    const auto kind = static_cast<std::uint16_t>(number);
    for (const bool odd : {false, true}) {
      table_.push_back(make_footprint(plain.of(kind, odd ? 1 : 0), state.lattice,
                                      state.kinds[kind].shape, candidates, odd));
    }
  }
}

}  // namespace clca::automaton
