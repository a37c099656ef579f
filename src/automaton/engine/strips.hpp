#pragma once
// The box cut into strips, one for each thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "automaton/engine/windowed_footprint.hpp"

namespace clca::automaton {

enum class Axis : std::uint8_t { columns, rows };

/// The sites of some columns or of some rows, from `first` to before `end`.
struct Interval {
  Axis axis = Axis::columns;
  int first = 0;
  int end = 0;

  bool contains(lattice::Site site) const {
    const int at = axis == Axis::columns ? site.column : site.row;
    return at >= first && at < end;
  }
};

/// Work by column and by row, in moves along gravity.
struct WorkHistogram {
  std::array<std::vector<std::uint32_t>, 2> lines;  ///< by Axis

  void add(lattice::Site site, std::uint32_t amount) {
    lines[0][static_cast<std::size_t>(site.column)] += amount;
    lines[1][static_cast<std::size_t>(site.row)] += amount;
  }
};

/// How far the windows of a particle reach from its reference site, those of sites that it wakes
/// included.
struct Reach {
  int left = 0;
  int right = 0;
  int down = 0;
  int up = 0;
};

/// Cuts a box so that each strip has about as much work as it had in the steps before. The cuts go
/// between columns or between rows: where there is less work at them, as threads wait for each
/// other there.
class Strips {
 public:
  Strips(const lattice::Lattice& lattice, const WindowedFootprints& footprints, std::size_t count);

  /// Which strip the particles of a (wrapped) site belong to.
  std::size_t of(lattice::Site site) const {
    const int at = axis_ == Axis::columns ? site.column : site.row;
    std::size_t strip = 0;
    while (strip < cuts_.size() && at >= cuts_[strip]) {
      ++strip;
    }
    return strip;
  }
  /// Where particles of the strip change and read no word of bits that particles of another strip
  /// change or read, unless they are at the periodic boundary.
  Interval inner(std::size_t strip) const;
  /// The same where one strip is the whole box.
  Interval whole_box() const {
    return {.axis = Axis::columns, .first = 0, .end = extents_[0].length};
  }
  /// Whether particles there reach across the periodic boundary.
  bool at_periodic_boundary(lattice::Site site) const {
    return extents_[0].wraps &&
           (site.column < reach_.left || site.column >= extents_[0].length - reach_.right);
  }

  WorkHistogram empty_histogram() const;
  /// Cuts again, by the sums of the histograms, which are cleared.
  void balance(std::span<WorkHistogram* const> histograms);

 private:
  struct Extent {
    int length = 0;
    int apart = 0;  ///< from a cut to the inner part of a strip
    bool wraps = false;
  };

  std::array<Extent, 2> extents_;  // by Axis
  Reach reach_;
  Axis axis_ = Axis::columns;
  std::vector<int> cuts_;  // where the second strip and those after it begin
};

}  // namespace clca::automaton
