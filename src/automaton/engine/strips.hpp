#pragma once
// The box cut into strips, one for each thread, and what a thread works on in a step.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "automaton/engine/windowed_footprint.hpp"
#include "automaton/rule/step.hpp"
#include "clca/grains/state.hpp"
#include "grains/internal/bitboard.hpp"

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
  std::array<std::vector<std::uint32_t>, 2> work_by_line;  ///< by Axis, then by column or row

  void add(lattice::Site site, std::uint32_t amount) {
    work_by_line[0][static_cast<std::size_t>(site.column)] += amount;
    work_by_line[1][static_cast<std::size_t>(site.row)] += amount;
  }
};

/// How far the windows of a particle reach from its reference site, with sites that it wakes.
struct Reach {
  int left = 0;
  int right = 0;
  int down = 0;
  int up = 0;
};

/// Cuts a box so that each strip has about as much work as it had in the steps before. The cuts go
/// between columns or between rows: where there is less work, as threads wait for each other there.
class Strips {
 public:
  Strips(const lattice::Lattice& lattice, const WindowedFootprints& footprints, std::size_t count);

  /// Index of the strip that the particles of a (wrapped) site belong to.
  std::size_t strip_of(lattice::Site site) const {
    const int at = axis_ == Axis::columns ? site.column : site.row;
    std::size_t strip = 0;
    while (strip < cuts_.size() && at >= cuts_[strip]) {
      ++strip;
    }
    return strip;
  }
  /// The part that shares no word of bits with other strips, except at the periodic boundary.
  Interval inner_interval(std::size_t strip) const;
  /// The interval of a single strip: all columns.
  Interval all_columns() const {
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
  /// The box along an axis, in columns or rows.
  struct Extent {
    int length = 0;
    int margin = 0;  ///< from a cut to the inner part of a strip
    bool wraps = false;
  };

  std::array<Extent, 2> extents_;  // by Axis
  Reach reach_;
  Axis axis_ = Axis::columns;
  std::vector<int> cuts_;  // where the second strip and those after it begin
};

inline constexpr std::size_t kCacheLine = 64;  // bytes

/// Elements in the order in which they were added. Memory is kept when it is cleared; unlike
/// std::vector, it neither constructs nor destroys what it has room for.
template <class T>
class ReusableBuffer {
 public:
  void add(const T& element) { add() = element; }
  /// Without a branch on `wanted`, for what a processor cannot predict.
  void add_if(bool wanted, const T& element) {
    add(element);
    count_ -= wanted ? 0U : 1U;
  }
  /// The new element holds what was there before; the caller fills it in.
  T& add() {
    if (count_ == capacity_) {
      elements_.resize(2 * count_ + 1);
      capacity_ = elements_.size();
    }
    return begin()[count_++];
  }
  void clear() { count_ = 0; }
  template <class Predicate>
  void erase_if(Predicate predicate) {
    count_ = static_cast<std::size_t>(std::remove_if(begin(), end(), predicate) - begin());
  }

  std::size_t size() const { return count_; }
  T* begin() { return elements_.data(); }
  T* end() { return begin() + count_; }
  const T* begin() const { return elements_.data(); }
  const T* end() const { return begin() + count_; }

 private:
  std::vector<T> elements_;
  std::size_t capacity_ = 0;  // elements_.size()
  std::size_t count_ = 0;
};

/// A set of ids. Visiting and clearing it takes time by its size, not by its bound.
class AwakeSet {
 public:
  /// Ids have to be below `bound`.
  void resize(std::size_t bound) { words_.resize((bound + kBits - 1) / kBits, 0); }

  /// Adds an id, unless it is in the set.
  void insert(std::uint32_t id) {
    std::uint64_t& word = words_[id / kBits];
    listed_.add_if((word & bit(id)) == 0, id);
    word |= bit(id);
  }
  bool contains(std::uint32_t id) const { return (words_[id / kBits] & bit(id)) != 0; }

  /// In the order in which they came.
  std::span<const std::uint32_t> ids() const { return {listed_.begin(), listed_.end()}; }

  void clear() {
    for (const std::uint32_t id : listed_) {
      words_[id / kBits] = 0;
    }
    listed_.clear();
  }

 private:
  static constexpr std::size_t kBits = 64;  // of a word

  static std::uint64_t bit(std::uint32_t id) { return std::uint64_t{1} << (id % kBits); }

  std::vector<std::uint64_t> words_;
  ReusableBuffer<std::uint32_t> listed_;
};

enum class ConflictOutcome : std::uint8_t {
  none,         ///< not known yet, or it lost its turn
  overlapping,  ///< the particle overlaps with something: its turn is among those of the contested
  won,          ///< it had its turn and moves
};

/// A particle with a provisional direction. Half a cache line, as it is used often in a step.
struct MoveProposal {
  lattice::Site site;             ///< the reference site when the step began, wrapped
  std::uint64_t taken_sites = 0;  ///< which sites of its one window were taken then
  std::uint32_t id = 0;
  std::uint32_t corner_byte = 0;  ///< of the corner of its one window, see Bitboard::Corner
  std::uint16_t kind = 0;
  grains::Move move = grains::kRest;  ///< kRest at the end of the step if it lost its turn
  grains::Access access = grains::Access::exclusive;
  ConflictOutcome outcome = ConflictOutcome::none;
  std::uint32_t contested_count : 24 = 0;  ///< number of lead sites that others want as well

  void add_contested(std::uint32_t sites) {
    contested_count = (contested_count + sites) & 0xFFFFFFU;
  }
};
static_assert(sizeof(MoveProposal) == kCacheLine / 2);

/// A proposal that waits for its turn.
struct QueuedMove {
  UpdateKey key;
  MoveProposal* proposal = nullptr;
};

/// Position of the one window of the proposal.
inline grains::Bitboard::Corner window_corner(const MoveProposal& proposal,
                                              const WindowedFootprint& footprint) {
  return {.byte = proposal.corner_byte,
          .column = grains::Bitboard::column_in_block(footprint.corner_from(proposal.site))};
}

/// Sites of a window whose owners wake.
struct WakeWindow {
  lattice::Site corner;
  std::uint64_t sites = 0;
};

/// The proposals of one strip that one worker has found. They have cache lines of their own, since
/// another thread writes to the next.
struct alignas(kCacheLine) Proposals {
  ReusableBuffer<MoveProposal> falling;  ///< along gravity
  ReusableBuffer<MoveProposal> sloping;  ///< in all other directions
};

/// The work of one thread: the moves of the particles in its strip, and the particles that wake
/// through them. Particles are examined by whichever thread is free.
struct alignas(kCacheLine) StripWorker {
  /// Bytes for a particle in the lists of `awake` and `awake_next`.
  static constexpr double kListedBytes = 2 * sizeof(std::uint32_t);
  /// Bytes for a particle that may move, in `proposals` and `wake_windows`.
  static constexpr double kAwakeBytes = sizeof(MoveProposal) + sizeof(WakeWindow);

  std::size_t strip = 0;
  Interval inner;         ///< of the strip: no other thread changes anything there in this step
  Interval inner_before;  ///< `inner` of the last step
  std::vector<Proposals> proposals;  ///< found by this worker, by strip
  AwakeSet awake;                    ///< to be examined, by what was in this strip in the last step
  AwakeSet awake_next;               ///< to be examined in the next step
  ReusableBuffer<WakeWindow> wake_windows;  ///< their particles go to `awake_next` soon
  std::vector<QueuedMove> queued_moves;     ///< contested moves in this strip
  WorkHistogram work;                       ///< see Strips
  std::size_t examined_count = 0;           ///< number of particles in this step
  std::size_t next_awake = 0;  ///< number of the next awake particle that no thread has taken
};

}  // namespace clca::automaton
