#pragma once
// What a thread has at hand for a strip of the box.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "automaton/awake_set.hpp"
#include "automaton/strips.hpp"
#include "automaton/update_order.hpp"
#include "clca/automaton/footprint.hpp"
#include "clca/automaton/state.hpp"

namespace clca::automaton {

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
  std::uint64_t taken = 0;  ///< then, in its window, if one is enough
  std::uint32_t id = 0;
  Move move = kRest;
  Access access = Access::alone;
  bool contested = false;
  bool engaged = false;  ///< overlaps with somebody: has its turn among the contested
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
  const Mover* mover = nullptr;
};

/// The work on one strip: its particles, and who wakes through their moves. One thread at a time.
struct alignas(64) Lane {
  std::size_t strip = 0;
  Columns inner;  ///< of the strip, where nobody else changes anything in this step
  std::vector<std::vector<std::uint32_t>> found;    ///< awake, by the strip where they stand
  std::vector<std::uint32_t> taken_over;            ///< found by others and not by itself
  std::vector<std::vector<std::uint32_t>> of_kind;  ///< being looked at
  std::vector<Mover> falling;                       ///< along gravity
  std::vector<Mover> sloping;                       ///< all other directions
  std::vector<Turn> turns;
  Rows claimed;                     ///< where the reference sites of the sloping movers lie
  std::vector<std::uint32_t> load;  ///< see Strips
  std::size_t looked_at = 0;
  AwakeSet own_awake;
  AwakeSet* awake = nullptr;  ///< that of the world for the first
};

}  // namespace clca::automaton
