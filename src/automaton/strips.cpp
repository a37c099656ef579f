#include "automaton/strips.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "clca/grains/site_bits.hpp"

namespace clca::automaton {

namespace {

/// Takes in a window whose lower left corner lies there, seen from a reference site.
void include(Reach& reach, lattice::Site corner) {
  reach.left = std::max(reach.left, -corner.column);
  reach.right = std::max(reach.right, corner.column + grains::kWindow - 1);
  reach.down = std::max(reach.down, -corner.row);
  reach.up = std::max(reach.up, corner.row + grains::kWindow - 1);
}

Reach reach_of(const grains::FootprintTable& footprints) {
  Reach reach;
  for (const grains::Footprint& footprint : footprints.all()) {
    include(reach, footprint.corner);
    for (const auto* patches : {&footprint.lead_patches, &footprint.swapped_patches}) {
      for (const std::vector<grains::Patch>& of_move : *patches) {
        for (const grains::Patch& patch : of_move) {
          include(reach, patch.corner({}));
        }
      }
    }
  }
  return reach;
}

/// Sums of all, which are empty afterwards.
std::vector<std::uint64_t> taken_together(std::span<Load* const> loads, std::size_t axis) {
  std::vector<std::uint64_t> sum(loads.front()->lines[axis].size(), 0);
  for (Load* load : loads) {
    for (std::size_t line = 0; line < sum.size(); ++line) {
      sum[line] += std::exchange(load->lines[axis][line], 0);
    }
  }
  return sum;
}

/// Where to cut into parts of equal load.
std::vector<int> equal_parts(const std::vector<std::uint64_t>& load, std::uint64_t total,
                             std::size_t parts) {
  std::vector<int> cuts;
  std::uint64_t done = 0;
  for (std::size_t line = 0; line < load.size(); ++line) {
    while (cuts.size() + 1 < parts && done >= total * (cuts.size() + 1) / parts) {
      cuts.push_back(static_cast<int>(line));
    }
    done += load[line];
  }
  cuts.resize(parts - 1, static_cast<int>(load.size()));
  return cuts;
}

/// The load so near to a cut.
std::uint64_t load_at(const std::vector<int>& cuts, const std::vector<std::uint64_t>& load,
                      int apart) {
  std::uint64_t sum = 0;
  for (const int cut : cuts) {
    const int end = std::min(cut + apart, static_cast<int>(load.size()));
    for (int line = std::max(cut - apart, 0); line < end; ++line) {
      sum += load[static_cast<std::size_t>(line)];
    }
  }
  return sum;
}

}  // namespace

Strips::Strips(const lattice::Lattice& lattice, const grains::FootprintTable& footprints,
               std::size_t count)
    : reach_(reach_of(footprints)) {
  // Others reach over a cut as far as one's own, and from there to the end of a word of bits.
  extents_ = {{{.length = lattice.columns(),
                .apart = reach_.left + reach_.right + 2 * grains::kWindow,
                .wraps = lattice.periodic()},
               {.length = lattice.rows(), .apart = reach_.down + reach_.up + grains::kWindow}}};
  for (std::size_t strip = 1; strip < count; ++strip) {
    const auto columns = static_cast<std::size_t>(lattice.columns());
    cuts_.push_back(static_cast<int>(columns * strip / count));
  }
}

Stretch Strips::inner(std::size_t strip) const {
  const Extent& extent = extents_[static_cast<std::size_t>(axis_)];
  const bool first = strip == 0 && !extent.wraps;
  const bool last = strip == cuts_.size() && !extent.wraps;
  return {.axis = axis_,
          .first = first ? 0 : (strip == 0 ? 0 : cuts_[strip - 1]) + extent.apart,
          .end = last ? extent.length
                      : (strip == cuts_.size() ? extent.length : cuts_[strip]) - extent.apart};
}

Load Strips::no_load() const {
  Load load;
  for (std::size_t axis = 0; axis < load.lines.size(); ++axis) {
    load.lines[axis].resize(static_cast<std::size_t>(extents_[axis].length), 0);
  }
  return load;
}

void Strips::balance(std::span<Load* const> loads) {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  const std::size_t parts = cuts_.size() + 1;
  for (const Axis axis : {Axis::columns, Axis::rows}) {
    const auto number = static_cast<std::size_t>(axis);
    const std::vector<std::uint64_t> load = taken_together(loads, number);
    const std::uint64_t total = std::accumulate(load.begin(), load.end(), std::uint64_t{0});
    if (total == 0) {
      return;  // nothing is known of where the work will be
    }
    const std::vector<int> cuts = equal_parts(load, total, parts);
    const std::uint64_t at_cuts = load_at(cuts, load, extents_[number].apart);
    if (at_cuts < least) {
      least = at_cuts;
      axis_ = axis;
      cuts_ = cuts;
    }
  }
}

}  // namespace clca::automaton
