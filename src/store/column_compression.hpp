#pragma once
// Columns of numbers compressed by zlib after sorting their bytes by significance: similar numbers
// share high bytes.

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace clca::store {

/// Maximum number of bytes that one compressed byte can expand to.
inline constexpr double kMaxExpansion = 1032;

namespace detail {

constexpr std::size_t kBlockNumbers = 1U << 16U;

template <std::size_t kSize>
struct Bits;
template <>
struct Bits<1> : std::type_identity<std::uint8_t> {};
template <>
struct Bits<2> : std::type_identity<std::uint16_t> {};
template <>
struct Bits<4> : std::type_identity<std::uint32_t> {};
template <>
struct Bits<8> : std::type_identity<std::uint64_t> {};

/// Lowest bytes of all numbers first, then the second bytes, and so on.
template <class T>
void sort_bytes(std::span<const T> values, std::span<std::uint8_t> bytes) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    std::transform(
        values.begin(), values.end(), bytes.subspan(i * values.size()).begin(), [i](T value) {
          return static_cast<std::uint8_t>(std::bit_cast<typename Bits<sizeof(T)>::type>(value) >>
                                           (8 * i));
        });
  }
}

template <class T>
void unsort_bytes(std::span<const std::uint8_t> bytes, std::span<T> values) {
  using Unsigned = typename Bits<sizeof(T)>::type;
  for (std::size_t number = 0; number < values.size(); ++number) {
    Unsigned bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bits = static_cast<Unsigned>(
          bits | (static_cast<Unsigned>(bytes[i * values.size() + number]) << (8 * i)));
    }
    values[number] = std::bit_cast<T>(bits);
  }
}

}  // namespace detail

class Compressor {
 public:
  Compressor();
  ~Compressor();
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  /// Appends a column to `output`; an empty column adds nothing.
  template <class T>
  void add(std::span<const T> values, std::vector<std::uint8_t>& output) {
    while (!values.empty()) {
      const auto block = values.first(std::min(values.size(), detail::kBlockNumbers));
      values = values.subspan(block.size());
      block_.resize(block.size_bytes());
      detail::sort_bytes(block, std::span(block_));
      compress_block(values.empty(), output);
    }
  }

 private:
  void compress_block(bool last, std::vector<std::uint8_t>& output);

  z_stream stream_{};
  std::vector<std::uint8_t> block_;
};

class Decompressor {
 public:
  Decompressor();
  ~Decompressor();
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;

  /// Throws std::runtime_error if `input` is not exactly such a column of this length.
  template <class T>
  void expand(std::span<const std::uint8_t> input, std::span<T> values) {
    begin(input, values.empty());
    while (!values.empty()) {
      const auto block = values.first(std::min(values.size(), detail::kBlockNumbers));
      values = values.subspan(block.size());
      block_.resize(block.size_bytes());
      expand_block(values.empty());
      detail::unsort_bytes(std::span<const std::uint8_t>(block_), block);
    }
  }

 private:
  void begin(std::span<const std::uint8_t> input, bool is_empty);
  void expand_block(bool last);
  int expand_some();

  z_stream stream_{};
  std::span<const std::uint8_t> input_;  // not yet given to the stream
  std::vector<std::uint8_t> block_;
};

}  // namespace clca::store
