#pragma once
// A bit for each site of a box, of which 64 are looked at or changed at once.

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "clca/automaton/lazy_array.hpp"
#include "clca/lattice/lattice.hpp"

namespace clca::automaton {

/// Columns and rows of a window.
inline constexpr int kWindow = 8;

/// A byte holds eight sites of a column, and the bytes of neighbouring columns are neighbours in
/// memory: eight of them, read from any column on, are a block of 8 columns by 8 rows, and two
/// blocks one above the other make a window of that size that may lie anywhere. Bit 8 i + j of a
/// window stands for the site i columns to the right of its lower left corner and j rows above.
/// There is room for windows that reach over the border of the box; they do not wrap. Single sites
/// are named by their place, see lattice::Lattice::index.
class SiteBits {
 public:
  /// Where a window lies; the same in all SiteBits of a lattice.
  struct Corner {
    std::size_t byte = 0;   ///< of its first column in the lower block
    std::uint32_t row = 0;  ///< of that block, where the window begins
  };

  explicit SiteBits(const lattice::Lattice& lattice)
      : stride_(static_cast<std::size_t>(lattice.stride())),
        width_((static_cast<std::size_t>(lattice.columns() + 2) + 3 * kSide) / kSide * kSide),
        words_(width_ / kSide * ((stride_ + 3 * kSide) / kSide)) {}

  /// Bytes for a lattice of so many places.
  static double bytes_for(double places) { return places / 8; }

  /// Of the window whose lower left site this is.
  Corner corner(lattice::Site site) const {
    const std::size_t row = static_cast<std::size_t>(site.row) + 1 + kSide;
    return {.byte = row / kSide * width_ + static_cast<std::size_t>(site.column) + 1 + kSide,
            .row = static_cast<std::uint32_t>(row % kSide)};
  }

  std::uint64_t window(Corner at) const {
    return joined({block(at.byte), block(at.byte + width_)}, at);
  }
  void set(Corner at, std::uint64_t window) {
    change(at, window, [](std::uint64_t block, std::uint64_t bits) { return block | bits; });
  }
  void clear(Corner at, std::uint64_t window) {
    change(at, window, [](std::uint64_t block, std::uint64_t bits) { return block & ~bits; });
  }
  void flip(Corner at, std::uint64_t window) {
    change(at, window, [](std::uint64_t block, std::uint64_t bits) { return block ^ bits; });
  }
  /// Clears the blocks that a window lies in, and so more sites than it has.
  void wipe(Corner at) {
    put_block(at.byte, 0);
    put_block(at.byte + width_, 0);
  }

  /// Whether a site is set from `low` to `high`, both included, of the box or its border.
  bool any(lattice::Site low, lattice::Site high) const {
    const Corner first = corner(low);
    const Corner last = corner(high);
    const std::size_t columns = static_cast<std::size_t>(high.column - low.column) + 1;
    const std::size_t blocks = (last.byte - first.byte) / width_;
    for (std::size_t block_row = 0; block_row <= blocks; ++block_row) {
      const std::uint64_t above = block_row == 0 ? 0xFFU << first.row : 0xFFU;
      const std::uint64_t below = block_row == blocks ? (2U << last.row) - 1 : 0xFFU;
      const std::size_t byte = first.byte + block_row * width_;
      for (std::size_t column = 0; column < columns; column += kSide) {
        const std::uint64_t wanted =
            first_columns(columns - column) & kEachColumn * (above & below);
        if ((block(byte + column) & wanted) != 0) {
          return true;
        }
      }
    }
    return false;
  }

  bool test(std::size_t place) const {
    const Corner at = this->at(place);
    return (bytes()[at.byte] >> at.row & 1U) != 0;
  }
  void set(std::size_t place) {
    const Corner at = this->at(place);
    bytes()[at.byte] |= static_cast<unsigned char>(1U << at.row);
  }
  void clear(std::size_t place) {
    const Corner at = this->at(place);
    bytes()[at.byte] &= static_cast<unsigned char>(~(1U << at.row));
  }

  // The same while other threads change other sites.
  /// Tells which of the sites were set before.
  std::uint64_t set_shared(Corner at, std::uint64_t window) {
    return change_shared(at, window, [](std::atomic_ref<std::uint64_t> word, auto bits) {
      return word.fetch_or(bits, std::memory_order_relaxed) & bits;
    });
  }
  void flip_shared(Corner at, std::uint64_t window) {
    change_shared(at, window, [](std::atomic_ref<std::uint64_t> word, auto bits) {
      return word.fetch_xor(bits, std::memory_order_relaxed) & bits;
    });
  }
  void wipe_shared(Corner at) {
    for (const std::size_t word : {at.byte / kSide, (at.byte + width_) / kSide}) {
      std::atomic_ref(words_[word]).store(0, std::memory_order_relaxed);
      std::atomic_ref(words_[word + 1]).store(0, std::memory_order_relaxed);
    }
  }
  /// Tells whether the bit was set before.
  bool set_shared(std::size_t place) { return set_shared(at(place), 1) != 0; }
  void clear_shared(std::size_t place) {
    const Corner at = this->at(place);
    const std::uint64_t bit = std::uint64_t{1} << (at.byte % kSide * kSide + at.row);
    std::atomic_ref(words_[at.byte / kSide]).fetch_and(~bit, std::memory_order_relaxed);
  }

 private:
  static constexpr std::size_t kSide = kWindow;
  static constexpr std::uint64_t kEachColumn = 0x0101010101010101;
  static_assert(std::endian::native == std::endian::little, "a block's first column comes first");

  /// A block and the one above it, or what of a window lies in each.
  struct Pair {
    std::uint64_t low = 0;
    std::uint64_t high = 0;
  };

  /// All sites in so many columns of a block.
  static std::uint64_t first_columns(std::size_t count) {
    return count >= kSide ? ~std::uint64_t{0} : (std::uint64_t{1} << (kSide * count)) - 1;
  }

  /// Those sites of a window that lie in its lower block.
  static std::uint64_t in_low(Corner at) { return kEachColumn * (0xFFU >> at.row); }
  static std::uint64_t joined(Pair blocks, Corner at) {
    const std::uint64_t low = in_low(at);
    return ((blocks.low >> at.row) & low) | ((blocks.high << (kSide - at.row)) & ~low);
  }
  static Pair parted(std::uint64_t window, Corner at) {
    const std::uint64_t low = in_low(at);
    return {.low = (window & low) << at.row, .high = (window & ~low) >> (kSide - at.row)};
  }

  Corner at(std::size_t place) const {
    const std::size_t row = place % stride_ + kSide;
    return {.byte = row / kSide * width_ + place / stride_ + kSide,
            .row = static_cast<std::uint32_t>(row % kSide)};
  }

  unsigned char* bytes() { return reinterpret_cast<unsigned char*>(words_.data()); }
  const unsigned char* bytes() const {
    return reinterpret_cast<const unsigned char*>(words_.data());
  }
  std::uint64_t block(std::size_t byte) const {
    std::uint64_t block = 0;
    std::memcpy(&block, bytes() + byte, sizeof block);
    return block;
  }
  void put_block(std::size_t byte, std::uint64_t block) {
    std::memcpy(bytes() + byte, &block, sizeof block);
  }

  template <class Change>
  void change(Corner at, std::uint64_t window, Change change) {
    const Pair bits = parted(window, at);
    put_block(at.byte, change(block(at.byte), bits.low));
    put_block(at.byte + width_, change(block(at.byte + width_), bits.high));
  }

  /// Word by word, as atomic operations want it. `change` returns those of its bits that were set.
  template <class Change>
  std::uint64_t change_block_shared(std::size_t byte, std::uint64_t bits, Change change) {
    const std::size_t word = byte / kSide;
    const auto shift = static_cast<unsigned>(byte % kSide * kSide);
    const auto change_word = [&](std::size_t place, std::uint64_t part) {
      return part == 0 ? 0 : change(std::atomic_ref(words_[place]), part);
    };
    const std::uint64_t left = change_word(word, bits << shift);
    const std::uint64_t right = change_word(word + 1, bits >> 1U >> (63U - shift));
    return left >> shift | right << 1U << (63U - shift);
  }
  template <class Change>
  std::uint64_t change_shared(Corner at, std::uint64_t window, Change change) {
    const Pair bits = parted(window, at);
    return joined({.low = change_block_shared(at.byte, bits.low, change),
                   .high = change_block_shared(at.byte + width_, bits.high, change)},
                  at);
  }

  std::size_t stride_;  ///< places of a column
  std::size_t width_;   ///< bytes of a row of blocks
  LazyArray<std::uint64_t> words_;
};

}  // namespace clca::automaton
