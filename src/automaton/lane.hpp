#pragma once
// What one thread has at hand in a step.

#include <cstdint>
#include <vector>

#include "automaton/awake_set.hpp"
#include "automaton/strips.hpp"
#include "automaton/update_order.hpp"
#include "clca/automaton/footprint.hpp"
#include "clca/automaton/state.hpp"

namespace clca::automaton {

/// A particle with a provisional direction.
struct Mover {
  lattice::Site site;  ///< the reference site when the step began, wrapped
  const Footprint* footprint = nullptr;
  std::uint64_t taken = 0;  ///< then, in its window, if one is enough
  std::uint32_t id = 0;
  Move move = kRest;
  bool near_border = false;  ///< of the strip of its thread, or across the seam of a periodic box
  bool contested = false;
  bool engaged = false;  ///< overlaps with somebody: has its turn among the contested
};

/// A contested mover and its place in the order.
struct Turn {
  UpdateKey key;
  const Mover* mover = nullptr;
};

/// The work of one thread: the particles of one strip, and who wakes through their moves.
struct alignas(64) Lane {
  std::size_t strip = 0;
  Columns inner;  ///< of the strip, where nobody else looks at or changes anything in this step
  std::vector<std::vector<std::uint32_t>> found;    ///< awake, by the strip where they stand
  std::vector<std::vector<std::uint32_t>> of_kind;  ///< being looked at
  std::vector<Mover> falling;                       ///< along gravity
  std::vector<Mover> sloping;                       ///< all other directions
  std::vector<Turn> turns;
  std::vector<std::uint32_t> load;  ///< see Strips
  std::size_t looked_at = 0;
  AwakeSet own_awake;
  AwakeSet* awake = nullptr;  ///< that of the world for the first
};

}  // namespace clca::automaton
