#include "automaton/engine/strips.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace clca::automaton {

namespace {

/// Sums the histograms and clears them.
std::vector<std::uint64_t> sum_and_clear(std::span<WorkHistogram* const> histograms,
                                         std::size_t axis) {
  std::vector<std::uint64_t> sum(histograms.front()->work_by_line[axis].size(), 0);
  for (WorkHistogram* work : histograms) {
    for (std::size_t line = 0; line < sum.size(); ++line) {
      sum[line] += std::exchange(work->work_by_line[axis][line], 0);
    }
  }
  return sum;
}

/// The cuts that make parts of equal work.
std::vector<int> balanced_cuts(const std::vector<std::uint64_t>& work, std::uint64_t total,
                               std::size_t parts) {
  std::vector<int> cuts;
  std::uint64_t done = 0;
  for (std::size_t line = 0; line < work.size(); ++line) {
    while (cuts.size() + 1 < parts && done >= total * (cuts.size() + 1) / parts) {
      cuts.push_back(static_cast<int>(line));
    }
    done += work[line];
  }
  cuts.resize(parts - 1, static_cast<int>(work.size()));
  return cuts;
}

/// The work closer than `margin` to a cut.
std::uint64_t work_near_cuts(const std::vector<int>& cuts, const std::vector<std::uint64_t>& work,
                             int margin) {
  std::uint64_t sum = 0;
  for (const int cut : cuts) {
    const int end = std::min(cut + margin, static_cast<int>(work.size()));
    for (int line = std::max(cut - margin, 0); line < end; ++line) {
      sum += work[static_cast<std::size_t>(line)];
    }
  }
  return sum;
}

}  // namespace

Strips::Strips(const lattice::Lattice& lattice, const WindowedFootprints& footprints,
               std::size_t count) {
  for (const WindowedFootprint& footprint : footprints.all()) {
    reach_.left = std::max(reach_.left, -footprint.lower_left.column);
    reach_.right = std::max(reach_.right, footprint.upper_right.column);
    reach_.down = std::max(reach_.down, -footprint.lower_left.row);
    reach_.up = std::max(reach_.up, footprint.upper_right.row);
  }
  // Particles on both sides reach over a cut, and from there to the end of a word of bits.
  extents_ = {{{.length = lattice.columns(),
                .margin = reach_.left + reach_.right + 2 * grains::kWindow,
                .wraps = lattice.periodic()},
               {.length = lattice.rows(), .margin = reach_.down + reach_.up + grains::kWindow}}};
  for (std::size_t strip = 1; strip < count; ++strip) {
    const auto columns = static_cast<std::size_t>(lattice.columns());
    cuts_.push_back(static_cast<int>(columns * strip / count));
  }
}

Interval Strips::inner_interval(std::size_t strip) const {
  const Extent& extent = extents_[static_cast<std::size_t>(axis_)];
  const bool first = strip == 0 && !extent.wraps;
  const bool last = strip == cuts_.size() && !extent.wraps;
  return {.axis = axis_,
          .first = first ? 0 : (strip == 0 ? 0 : cuts_[strip - 1]) + extent.margin,
          .end = last ? extent.length
                      : (strip == cuts_.size() ? extent.length : cuts_[strip]) - extent.margin};
}

WorkHistogram Strips::empty_histogram() const {
  WorkHistogram work;
  for (std::size_t axis = 0; axis < work.work_by_line.size(); ++axis) {
    work.work_by_line[axis].resize(static_cast<std::size_t>(extents_[axis].length), 0);
  }
  return work;
}

void Strips::balance(std::span<WorkHistogram* const> histograms) {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  const std::size_t parts = cuts_.size() + 1;
  for (const Axis axis : {Axis::columns, Axis::rows}) {
    const auto number = static_cast<std::size_t>(axis);
    const std::vector<std::uint64_t> work = sum_and_clear(histograms, number);
    const std::uint64_t total = std::accumulate(work.begin(), work.end(), std::uint64_t{0});
    if (total == 0) {
      return;  // nothing is known about the work to come
    }
    const std::vector<int> cuts = balanced_cuts(work, total, parts);
    const std::uint64_t near_cuts = work_near_cuts(cuts, work, extents_[number].margin);
    if (near_cuts < least) {
      least = near_cuts;
      axis_ = axis;
      cuts_ = cuts;
    }
  }
}

}  // namespace clca::automaton
