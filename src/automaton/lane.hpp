#pragma once
// What a thread has at hand for a strip of the box.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "automaton/awake_set.hpp"
#include "automaton/bag.hpp"
#include "automaton/strips.hpp"
#include "automaton/update_order.hpp"
#include "clca/automaton/footprint.hpp"
#include "clca/automaton/site_bits.hpp"
#include "clca/automaton/state.hpp"

namespace clca::automaton {

inline constexpr std::size_t kCacheLine = 64;  // bytes

/// How a particle's bits are to be looked at and changed.
enum class Access : std::uint8_t {
  alone,   ///< by windows; nobody else is near
  shared,  ///< by windows; another thread may be busy in the same blocks
  seam,    ///< site by site: what is near may lie across the seam of a periodic box
};

/// A particle with a provisional direction.
struct Mover {
  lattice::Site site;  ///< the reference site when the step began, wrapped
  const Footprint* footprint = nullptr;
  // Of those for which one window is enough, away from a seam:
  SiteBits::Corner at = {};
  std::uint64_t taken = 0;  ///< when the step began
  std::uint32_t id = 0;
  std::uint16_t strip = 0;
  Move move = kRest;
  Access access = Access::alone;
  bool engaged = false;         ///< overlaps with somebody: has its turn among the contested
  bool won = false;             ///< what it contested
  std::uint16_t contested = 0;  ///< so many of its lead sites others want as well
};

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

/// A contested mover and its place in the order.
struct Turn {
  UpdateKey key;
  Mover* mover = nullptr;

  bool operator<(const Turn& other) const { return key < other.key; }
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
  std::vector<Turn> turns;
  Rows claimed;  ///< where the reference sites of the sloping movers lie
  Load load;     ///< see Strips
  std::size_t looked_at = 0;
  std::size_t dealt = 0;  ///< so many of those awake here have been dealt out
  AwakeSet awake;         ///< by its moves, for the next step
};

}  // namespace clca::automaton
