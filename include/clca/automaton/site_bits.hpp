#pragma once
// A bit for each site of a box, of which 64 are looked at or changed at once.

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "clca/automaton/lazy_array.hpp"
#include "clca/lattice/lattice.hpp"

namespace clca::automaton {

/// Columns and rows of a window.
inline constexpr int kWindow = 8;

/// Kept as blocks of 8 columns by 8 rows, one in a word, with room for windows that reach over the
/// border of the box. A window is as large as a block and may lie anywhere: bit 8 i + j stands for
/// the site i columns to the right of its lower left corner and j rows above. Single sites are
/// named by their place, see lattice::Lattice::index. Windows do not wrap.
class SiteBits {
 public:
  explicit SiteBits(const lattice::Lattice& lattice)
      : stride_(lattice.memory_size() / static_cast<std::size_t>(lattice.columns() + 2)),
        height_((stride_ + kMargin) / kSide + 2),
        words_((static_cast<std::size_t>(lattice.columns() + 2) + kMargin + kSide) / kSide *
                   height_ +
               2 * height_) {}

  /// Bytes for a lattice of so many places.
  static double bytes_for(double places) { return places / 8; }

  /// Places of a column.
  std::size_t stride() const { return stride_; }

  [[gnu::always_inline]] std::uint64_t window(lattice::Site corner) const {
    const Corner at(*this, corner);
    const std::uint64_t* low = words_.data() + at.word;
    const std::uint64_t* high = low + height_;
    return at.shift_columns(at.join_rows(low[0], low[1]), at.join_rows(high[0], high[1]));
  }
  void set(lattice::Site corner, std::uint64_t window) {
    change(corner, window, [](std::uint64_t& word, std::uint64_t bits) { word |= bits; });
  }
  void clear(lattice::Site corner, std::uint64_t window) {
    change(corner, window, [](std::uint64_t& word, std::uint64_t bits) { word &= ~bits; });
  }
  void flip(lattice::Site corner, std::uint64_t window) {
    change(corner, window, [](std::uint64_t& word, std::uint64_t bits) { word ^= bits; });
  }

  /// Whether a place of one column from `first` to before `end` is set.
  bool any(std::size_t first, std::size_t end) const {
    const std::size_t column = first / stride_ + kSide;
    const std::size_t low = first % stride_ + kSide;
    const std::size_t high = low + (end - first);
    const std::uint64_t* words = words_.data() + column / kSide * height_;
    const std::size_t shift = column % kSide * kSide;
    for (std::size_t row = low; row < high; row = (row / kSide + 1) * kSide) {
      const std::size_t rows = std::min(high - row, kSide - row % kSide);
      const std::uint64_t wanted = ((std::uint64_t{1} << rows) - 1) << (shift + row % kSide);
      if ((words[row / kSide] & wanted) != 0) {
        return true;
      }
    }
    return false;
  }

  bool test(std::size_t place) const {
    const One one(*this, place);
    return (words_[one.word] & one.bit) != 0;
  }
  void set(std::size_t place) {
    const One one(*this, place);
    words_[one.word] |= one.bit;
  }
  void clear(std::size_t place) {
    const One one(*this, place);
    words_[one.word] &= ~one.bit;
  }

  // The same while other threads change other sites.
  /// Tells which of the sites were set before.
  std::uint64_t set_shared(lattice::Site corner, std::uint64_t window) {
    return change_shared(corner, window, [](std::atomic_ref<std::uint64_t> word, auto bits) {
      return word.fetch_or(bits, std::memory_order_relaxed) & bits;
    });
  }
  void clear_shared(lattice::Site corner, std::uint64_t window) {
    change_shared(corner, window, [](std::atomic_ref<std::uint64_t> word, auto bits) {
      return word.fetch_and(~bits, std::memory_order_relaxed) & bits;
    });
  }
  void flip_shared(lattice::Site corner, std::uint64_t window) {
    change_shared(corner, window, [](std::atomic_ref<std::uint64_t> word, auto bits) {
      return word.fetch_xor(bits, std::memory_order_relaxed) & bits;
    });
  }
  /// Tells whether the bit was set before.
  bool set_shared(std::size_t place) {
    const One one(*this, place);
    std::atomic_ref word(words_[one.word]);
    return (word.fetch_or(one.bit, std::memory_order_relaxed) & one.bit) != 0;
  }
  void clear_shared(std::size_t place) {
    const One one(*this, place);
    std::atomic_ref word(words_[one.word]);
    word.fetch_and(~one.bit, std::memory_order_relaxed);
  }

 private:
  static constexpr std::size_t kSide = kWindow;
  static constexpr std::size_t kMargin = 2 * kSide;  // a block on each side
  static constexpr std::uint64_t kEachColumn = 0x0101010101010101;

  /// Where a window lies among the blocks: in one, or in two or four neighbours.
  struct Corner {
    Corner(const SiteBits& bits, lattice::Site site)
        : Corner(bits.height_, static_cast<std::size_t>(site.column) + 1 + kSide,
                 static_cast<std::size_t>(site.row) + 1 + kSide) {}
    Corner(std::size_t height, std::size_t column, std::size_t row)
        : word(column / kSide * height + row / kSide),
          rows(static_cast<unsigned>(row % kSide)),
          columns(static_cast<unsigned>(column % kSide * kSide)),
          kept(kEachColumn * (0xFFU >> rows)) {}

    /// Rows of a block and of that above it as rows of the window.
    std::uint64_t join_rows(std::uint64_t block, std::uint64_t above) const {
      return ((block >> rows) & kept) | ((above << (kSide - rows)) & ~kept);
    }
    /// Columns of what is so joined and of its right neighbour as columns of the window.
    std::uint64_t shift_columns(std::uint64_t left, std::uint64_t right) const {
      return left >> columns | right << 1U << (63U - columns);
    }

    std::size_t word = 0;  ///< the lower left block
    unsigned rows = 0;     ///< of the block that lie below the window
    unsigned columns = 0;  ///< that lie to the left of it, in bits
    std::uint64_t kept = 0;
  };

  struct One {
    One(const SiteBits& bits, std::size_t place) {
      const std::size_t column = place / bits.stride_ + kSide;
      const std::size_t row = place % bits.stride_ + kSide;
      word = column / kSide * bits.height_ + row / kSide;
      bit = std::uint64_t{1} << (column % kSide * kSide + row % kSide);
    }

    std::size_t word = 0;
    std::uint64_t bit = 0;
  };

  /// What of a window lies in each of the four blocks: at the corner, above it, and to the right of
  /// these.
  static std::array<std::uint64_t, 4> parts(const Corner& at, std::uint64_t window) {
    const std::uint64_t left = window << at.columns;
    const std::uint64_t right = window >> 1U >> (63U - at.columns);
    const std::uint64_t up = kEachColumn * (0xFFU << at.rows & 0xFFU);
    return {left << at.rows & up, left >> (kSide - at.rows) & ~up, right << at.rows & up,
            right >> (kSide - at.rows) & ~up};
  }
  std::array<std::uint64_t*, 4> blocks(const Corner& at) {
    std::uint64_t* low = words_.data() + at.word;
    return {low, low + 1, low + height_, low + height_ + 1};
  }
  template <class Change>
  void change(lattice::Site corner, std::uint64_t window, Change change) {
    const Corner at(*this, corner);
    const auto bits = parts(at, window);
    const auto words = blocks(at);
    for (std::size_t i = 0; i < words.size(); ++i) {
      change(*words[i], bits[i]);
    }
  }
  /// `change` returns those of its bits that were set; so does this.
  template <class Change>
  std::uint64_t change_shared(lattice::Site corner, std::uint64_t window, Change change) {
    const Corner at(*this, corner);
    auto bits = parts(at, window);
    const auto words = blocks(at);
    for (std::size_t i = 0; i < words.size(); ++i) {
      bits[i] = bits[i] == 0 ? 0 : change(std::atomic_ref(*words[i]), bits[i]);
    }
    return at.shift_columns(at.join_rows(bits[0], bits[1]), at.join_rows(bits[2], bits[3]));
  }

  std::size_t stride_;  ///< places of a column
  std::size_t height_;  ///< blocks of a column
  LazyArray<std::uint64_t> words_;
};

}  // namespace clca::automaton
