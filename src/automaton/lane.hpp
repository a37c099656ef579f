#pragma once
// What a thread has at hand for a strip of the box.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "automaton/awake_set.hpp"
#include "automaton/bag.hpp"
#include "automaton/strips.hpp"
#include "automaton/turns.hpp"
#include "clca/grains/footprint.hpp"
#include "clca/grains/site_bits.hpp"
#include "clca/grains/state.hpp"

namespace clca::automaton {

inline constexpr std::size_t kCacheLine = 64;  // bytes

/// How a particle's bits are to be looked at and changed.
enum class Access : std::uint8_t {
  alone,   ///< by windows; nobody else is near
  shared,  ///< by windows; another thread may be busy in the same blocks
  seam,    ///< site by site: what is near may lie across the seam of a periodic box
};

/// A particle that is looked at.
struct Candidate {
  lattice::Site site;  ///< the reference site, wrapped
  std::uint32_t id = 0;
  std::uint16_t kind = 0;
  grains::Move previous = grains::kRest;
};

/// Of a mover on the sites that it wants.
enum class Standing : std::uint8_t {
  usual,
  engaged,  ///< it overlaps with somebody: has its turn among the contested
  won,      ///< it was contested
};

/// A particle with a provisional direction. Small: each is read and written several times a step.
struct Mover {
  lattice::Site site;       ///< the reference site when the step began, wrapped
  std::uint64_t taken = 0;  ///< then, too: of its window, where one is enough, away from a seam
  std::uint32_t id = 0;
  std::uint32_t byte = 0;  ///< SiteBits::Corner of the window
  std::uint16_t kind = 0;
  std::uint16_t contested = 0;  ///< so many of its lead sites others want as well
  grains::Move move =
      grains::kRest;  ///< that it wants; in the end, of one that has lost against others, none
  grains::Move previous = grains::kRest;
  Access access = Access::alone;
  Standing standing = Standing::usual;
};
static_assert(sizeof(Mover) == kCacheLine / 2);

/// Of its window.
inline grains::SiteBits::Corner corner(const Mover& mover, const grains::Footprint& footprint) {
  return {.byte = mover.byte,
          .column = grains::SiteBits::column_in_block(footprint.corner_from(mover.site))};
}

/// What a move adds to column and row, by the parity of the column and by Move.
inline constexpr auto kSteps = [] {
  std::array<std::array<lattice::Site, lattice::kDirectionCount + 1>, 2> steps{};
  for (const int column : {0, 1}) {
    for (const lattice::Direction direction : lattice::kDirections) {
      const lattice::Site to = lattice::Site{column, 0} + unit(direction);
      steps[static_cast<std::size_t>(column)][index_of(direction)] = {to.column - column, to.row};
    }
  }
  return steps;
}();
inline lattice::Site step_of(lattice::Site site, grains::Move move) {
  return kSteps[static_cast<std::size_t>(site.column & 1)][move];
}

/// From `low` to `high`, both included.
struct Rows {
  int low = std::numeric_limits<int>::max();
  int high = std::numeric_limits<int>::min();

  bool contains(int row) const { return row >= low && row <= high; }
  void include(int row) { include(Rows{row, row}); }
  void include(Rows other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
  Rows widened(int by) const { return low > high ? Rows() : Rows{low - by, high + by}; }
};

/// Sites whose owners wake: some of a window.
struct Wake {
  lattice::Site corner;
  std::uint64_t sites = 0;
};

/// Each on a line of the cache of its own: another thread is writing to the next.
struct alignas(kCacheLine) Movers {
  Bag<Mover> falling;  ///< along gravity
  Bag<Mover> sloping;  ///< all other directions
};

/// The work of one thread: the moves of the particles in its strip, and who wakes through them.
/// Looks at particles are dealt out by number.
struct alignas(kCacheLine) Lane {
  std::size_t strip = 0;
  Stretch inner;         ///< of the strip, where nobody else changes anything in this step
  Stretch inner_before;  ///< in the step before
  std::vector<Bag<std::uint32_t>> of_kind;  ///< ids being looked at
  std::vector<Movers> movers;               ///< found by the looks, by strip
  std::vector<Movers> movers_before;        ///< in the step before: they are awake
  AwakeSet awake;   ///< by the moves of the step before here; the movers themselves are marked
  AwakeSet waking;  ///< the same for the next step
  Bag<Wake> to_wake;
  std::vector<Turn> turns;
  std::vector<Turn> open;  ///< those that are not for this thread alone to decide
  Rows claimed;            ///< where the reference sites of the sloping movers lie
  Load load;               ///< see Strips
  std::size_t looked_at = 0;
  std::size_t dealt = 0;  ///< so many of those awake here have been dealt out
};

}  // namespace clca::automaton
