#include "automaton/engine/windowed_footprint.hpp"

#include <algorithm>

#include "grains/internal/bitboard.hpp"

namespace clca::automaton {

namespace {

using lattice::Axial;
using lattice::Direction;

/// Columns and rows from a site in an odd or even column to the one at this lattice vector from it.
lattice::Site column_row_offset(bool odd_column, Axial site) {
  const lattice::Site from = {odd_column ? 1 : 0, 0};
  const lattice::Site to = from + site;
  return {to.column - from.column, to.row};
}

/// The masks of the adjacent windows from `low` on that contain sites.
std::vector<WindowMask> window_masks(const std::vector<Axial>& sites, bool odd_column,
                                     lattice::Site low) {
  std::vector<WindowMask> result;
  for (const Axial site : sites) {
    const lattice::Site at = column_row_offset(odd_column, site);
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

/// Sites from which a candidate move leads into one that the step of a shape vacates, without those
/// that the shape covers before or after it.
std::vector<Axial> upstream(const lattice::Shape& shape, Direction step,
                            std::span<const Direction> candidates) {
  std::vector<Axial> result;
  for (const Axial site : shape.trail_sites(step)) {
    for (const Direction direction : candidates) {
      result.push_back(site - unit(direction));
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  std::erase_if(result, [&](Axial site) {
    return shape.contains(site) || shape.contains(site - unit(step));
  });
  return result;
}

std::vector<Axial> concatenated(std::vector<Axial> first, const std::vector<Axial>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<ExchangeGroup> exchanges(const std::vector<lattice::IndexOffset>& lead,
                                     const std::vector<lattice::IndexOffset>& trail) {
  std::vector<ExchangeGroup> result((lead.size() + kExchangesPerGroup - 1) / kExchangesPerGroup);
  for (std::size_t i = 0; i < kExchangesPerGroup * result.size(); ++i) {
    const std::size_t site = i % lead.size();
    result[i / kExchangesPerGroup][i % kExchangesPerGroup] = {lead[site].index, trail[site].index};
  }
  return result;
}

WindowedFootprint make_footprint(const grains::Footprint& plain, const lattice::Lattice& lattice,
                                 const lattice::Shape& shape, std::span<const Direction> candidates,
                                 bool odd_column) {
  WindowedFootprint footprint(plain);
  WindowedFootprint::PerDirection<Axial> wake;
  std::vector<Axial> all = shape.sites();
  for (const Direction direction : lattice::kDirections) {
    wake[index_of(direction)] = upstream(shape, direction, candidates);
    all = concatenated(concatenated(all, shape.lead_sites(direction)), wake[index_of(direction)]);
  }
  lattice::Site low;
  lattice::Site high;
  for (const Axial site : all) {
    const lattice::Site at = column_row_offset(odd_column, site);
    low = {std::min(low.column, at.column), std::min(low.row, at.row)};
    high = {std::max(high.column, at.column), std::max(high.row, at.row)};
  }
  const int across = (high.column - low.column) / grains::kWindow + 1;
  const int upwards = (high.row - low.row) / grains::kWindow + 1;
  footprint.fits_one_window = across == 1 && upwards == 1;
  footprint.lower_left = low;
  footprint.upper_right = {low.column + across * grains::kWindow - 1,
                           low.row + upwards * grains::kWindow - 1};
  for (const Direction direction : lattice::kDirections) {
    const std::size_t d = index_of(direction);
    const std::vector<Axial> lead = shape.lead_sites(direction);
    footprint.exchanges[d] = exchanges(footprint.lead_sites[d], footprint.trail_sites[d]);
    footprint.wake_sites[d] = grains::index_offsets(lattice, wake[d], odd_column);
    footprint.lead_masks[d] = window_masks(lead, odd_column, low);
    footprint.changed_masks[d] =
        window_masks(concatenated(lead, shape.trail_sites(direction)), odd_column, low);
    if (footprint.fits_one_window) {
      const std::vector<WindowMask> woken = window_masks(wake[d], odd_column, low);
      footprint.move_windows[d] = {.lead_sites = footprint.lead_masks[d].front().sites,
                                   .changed_sites = footprint.changed_masks[d].front().sites,
                                   .wake_sites = woken.empty() ? 0 : woken.front().sites};
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
      table_.push_back(make_footprint(plain.footprint(kind, odd ? 1 : 0), state.lattice,
                                      state.kinds[kind].shape, candidates, odd));
    }
  }
}

}  // namespace clca::automaton
