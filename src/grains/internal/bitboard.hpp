#pragma once
// One bit per site of a box. 64 bits are read or changed at once.

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "clca/lattice/lattice.hpp"
#include "grains/internal/lazy_array.hpp"

namespace clca::grains {

/// Number of columns and of rows of a window.
inline constexpr int kWindow = 8;

/// Whether other threads may change sites nearby at the same time.
enum class Access : std::uint8_t { exclusive, shared };

/// A byte holds eight sites of a row; the bytes of a column of blocks follow each other upwards.
/// Any eight of them are a block of 8 x 8 sites.
/// A window is any 8 x 8 square of sites, made of two neighbouring blocks. Bit i + 8 j is the site
/// i columns right of the lower left corner and j rows above it.
/// Windows may reach beyond the border of the box; they do not wrap. Single sites are given by
/// lattice::Lattice::index.
class Bitboard {
 public:
  /// Position of a window of 8 x 8 sites; the same for all Bitboards of a lattice.
  struct Corner {
    std::size_t byte = 0;      ///< byte of its first row in the left block; below 2^32
    std::uint32_t column = 0;  ///< column of that block where the window begins
  };

  /// Throws std::length_error for more than 2^35 sites.
  explicit Bitboard(const lattice::Lattice& lattice)
      : lattice_(lattice),
        height_((static_cast<std::size_t>(lattice.rows() + 2) + 4 * kSide) / kSide * kSide),
        words_(checked(height_ / kSide * block_columns(lattice))) {}

  /// Bytes for a lattice with this index_count().
  static double bytes_for(double index_count) { return index_count / 8; }

  /// The window whose lower left site this is.
  Corner corner(lattice::Site site) const {
    const std::size_t column = static_cast<std::size_t>(site.column) + 1 + kSide;
    return {.byte = column / kSide * height_ + static_cast<std::size_t>(site.row) + 1 + kSide,
            .column = static_cast<std::uint32_t>(column % kSide)};
  }
  /// Corner::column of that window.
  static std::uint32_t column_in_block(lattice::Site site) {
    return static_cast<std::uint32_t>(site.column + 1) % kSide;
  }

  std::uint64_t window(Corner at) const {
    return joined_window({block(at.byte), block(at.byte + height_)}, at);
  }
  /// Returns which of the sites were set before.
  std::uint64_t set(Corner at, std::uint64_t window, Access access = Access::exclusive) {
    if (access == Access::shared) {
      return change_shared(at, window, [](std::atomic_ref<std::uint64_t> word, auto bits) {
        return word.fetch_or(bits, std::memory_order_relaxed) & bits;
      });
    }
    const std::uint64_t before = this->window(at) & window;
    change(at, window, [](std::uint64_t block, std::uint64_t bits) { return block | bits; });
    return before;
  }
  void clear(Corner at, std::uint64_t window) {
    change(at, window, [](std::uint64_t block, std::uint64_t bits) { return block & ~bits; });
  }
  [[gnu::always_inline]] void flip(Corner at, std::uint64_t window,
                                   Access access = Access::exclusive) {
    if (access == Access::shared) {
      change_shared(at, window, [](std::atomic_ref<std::uint64_t> word, auto bits) {
        return word.fetch_xor(bits, std::memory_order_relaxed) & bits;
      });
    } else {
      change(at, window, [](std::uint64_t block, std::uint64_t bits) { return block ^ bits; });
    }
  }
  /// Clears both blocks of a window, which is more than the window.
  void clear_blocks(Corner at, Access access = Access::exclusive) {
    if (access == Access::exclusive) {
      put_block(at.byte, 0);
      put_block(at.byte + height_, 0);
      return;
    }
    for (const std::size_t word : {at.byte / kSide, (at.byte + height_) / kSide}) {
      std::atomic_ref(words_[word]).store(0, std::memory_order_relaxed);
      std::atomic_ref(words_[word + 1]).store(0, std::memory_order_relaxed);
    }
  }

  void set(std::size_t index) {
    const Corner at = this->at(index);
    bytes()[at.byte] |= static_cast<unsigned char>(1U << at.column);
  }
  void clear(std::size_t index) {
    const Corner at = this->at(index);
    bytes()[at.byte] &= static_cast<unsigned char>(~(1U << at.column));
  }

 private:
  /// Sites along an edge of a block; also the bytes of a block, and the bits of a byte.
  static constexpr std::size_t kSide = kWindow;
  static constexpr std::size_t kMaxWords = std::size_t{1} << 29U;
  static constexpr std::uint64_t kEachRow = 0x0101010101010101;  // the first site of each row
  static_assert(std::endian::native == std::endian::little, "the first row of a block comes first");

  /// A block and its right neighbour, or the part of a window in each.
  struct Pair {
    std::uint64_t left = 0;
    std::uint64_t right = 0;
  };

  /// Number of columns of blocks.
  static std::size_t block_columns(const lattice::Lattice& lattice) {
    return (static_cast<std::size_t>(lattice.columns() + 2) + 3 * kSide) / kSide;
  }

  static std::size_t checked(std::size_t words) {
    if (words > kMaxWords) {
      throw std::length_error("a box has at most 2^35 sites");
    }
    return words;
  }

  /// The sites of a window that lie in its left block.
  static std::uint64_t in_left(Corner at) { return kEachRow * (0xFFU >> at.column); }
  static std::uint64_t joined_window(Pair blocks, Corner at) {
    const std::uint64_t left = in_left(at);
    return ((blocks.left >> at.column) & left) | ((blocks.right << (kSide - at.column)) & ~left);
  }
  static Pair parts_of_window(std::uint64_t window, Corner at) {
    const std::uint64_t left = in_left(at);
    return {.left = (window & left) << at.column, .right = (window & ~left) >> (kSide - at.column)};
  }

  Corner at(std::size_t index) const { return corner(lattice_.site(index)); }

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
    const Pair bits = parts_of_window(window, at);
    put_block(at.byte, change(block(at.byte), bits.left));
    put_block(at.byte + height_, change(block(at.byte + height_), bits.right));
  }

  /// Word by word, for atomic operations. `change` returns which of its bits were set before.
  template <class Change>
  std::uint64_t change_block_shared(std::size_t byte, std::uint64_t bits, Change change) {
    const std::size_t word = byte / kSide;
    const auto shift = static_cast<unsigned>(byte % kSide * kSide);
    const auto change_word = [&](std::size_t number, std::uint64_t part) {
      return part == 0 ? 0 : change(std::atomic_ref(words_[number]), part);
    };
    const std::uint64_t left = change_word(word, bits << shift);
    const std::uint64_t right = change_word(word + 1, bits >> 1U >> (63U - shift));
    return left >> shift | right << 1U << (63U - shift);
  }
  template <class Change>
  std::uint64_t change_shared(Corner at, std::uint64_t window, Change change) {
    const Pair bits = parts_of_window(window, at);
    return joined_window({.left = change_block_shared(at.byte, bits.left, change),
                          .right = change_block_shared(at.byte + height_, bits.right, change)},
                         at);
  }

  lattice::Lattice lattice_;
  std::size_t height_;  ///< bytes of a column of blocks
  LazyArray<std::uint64_t> words_;
};

}  // namespace clca::grains
