#pragma once
// What one thread works on in a step.

#include <array>
#include <cstdint>
#include <vector>

#include "automaton/engine/awake_set.hpp"
#include "automaton/engine/strips.hpp"
#include "automaton/engine/windowed_footprint.hpp"
#include "automaton/rule/update_order.hpp"
#include "clca/grains/state.hpp"
#include "grains/internal/bitboard.hpp"

namespace clca::automaton {

inline constexpr std::size_t kCacheLine = 64;  // bytes

/// A particle that is examined.
struct AwakeParticle {
  lattice::Site site;  ///< the reference site, wrapped
  std::uint32_t id = 0;
  std::uint16_t kind = 0;
  grains::Move previous = grains::kRest;
};

enum class ConflictOutcome : std::uint8_t {
  none,         ///< not known yet, or it lost its turn
  overlapping,  ///< the particle overlaps with something: its turn is among those of the contested
  won,          ///< it had its turn and moves
};

/// A particle with a provisional direction. Half a cache line, as it is read and written several
/// times a step.
struct MoveProposal {
  lattice::Site site;       ///< the reference site when the step began, wrapped
  std::uint64_t taken = 0;  ///< which sites of its one window were taken then
  std::uint32_t id = 0;
  std::uint32_t byte = 0;  ///< of the corner of its one window, see Bitboard::Corner
  std::uint16_t kind = 0;
  grains::Move move = grains::kRest;  ///< kRest at the end of the step if it lost its turn
  grains::Access access = grains::Access::exclusive;
  ConflictOutcome outcome = ConflictOutcome::none;
  std::uint32_t contested : 24 = 0;  ///< how many of its lead sites others want as well

  void contest(std::uint32_t sites) { contested = (contested + sites) & 0xFFFFFFU; }
};
static_assert(sizeof(MoveProposal) == kCacheLine / 2);

/// A proposal that waits for its turn.
struct QueuedMove {
  UpdateKey key;
  MoveProposal* proposal = nullptr;
};

/// Where the one window of the proposal lies.
inline grains::Bitboard::Corner corner(const MoveProposal& proposal,
                                       const WindowedFootprint& footprint) {
  return {.byte = proposal.byte,
          .column = grains::Bitboard::column_in_block(footprint.corner_from(proposal.site))};
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

/// Sites of a window whose owners wake.
struct WakeWindow {
  lattice::Site corner;
  std::uint64_t sites = 0;
};

/// On cache lines of its own: another thread writes to the next.
struct alignas(kCacheLine) Proposals {
  ReusableBuffer<MoveProposal> falling;  ///< along gravity
  ReusableBuffer<MoveProposal> sloping;  ///< in all other directions
};

/// The work of one thread: the moves of the particles in its strip, and the particles that wake
/// through them. Particles are examined by whichever thread is free.
struct alignas(kCacheLine) StripWorker {
  // Of a particle in the lists: of those to look at, now and next, and of one that may move.
  static constexpr double kListedBytes = 2 * sizeof(std::uint32_t);
  static constexpr double kAwakeBytes = sizeof(MoveProposal) + sizeof(WakeWindow);

  std::size_t strip = 0;
  Interval inner;         ///< of the strip: no other thread changes anything there in this step
  Interval inner_before;  ///< the same in the last step
  std::vector<Proposals> proposals;  ///< found by this worker, by strip
  AwakeSet awake;                    ///< by what was here in the last step
  AwakeSet waking;                   ///< the same for the next step
  ReusableBuffer<WakeWindow> to_wake;
  std::vector<QueuedMove> turns;  ///< contested moves in this strip
  WorkHistogram work;             ///< see Strips
  std::size_t examined = 0;
  std::size_t next_awake = 0;  ///< number of the next awake particle that no thread has taken
};

}  // namespace clca::automaton
