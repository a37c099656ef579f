#include "store/column_compression.hpp"

#include <array>
#include <new>
#include <stdexcept>

namespace clca::store {

namespace {

constexpr int kLevel = 1;  // more costs time and gains little on sorted bytes

void require_whole(bool holds) {
  if (!holds) {
    throw std::runtime_error("its compressed data is damaged");
  }
}

}  // namespace

Compressor::Compressor() {
  if (::deflateInit(&stream_, kLevel) != Z_OK) {
    throw std::bad_alloc();
  }
}

Compressor::~Compressor() {
  ::deflateEnd(&stream_);
}

void Compressor::compress_block(bool last, std::vector<std::uint8_t>& output) {
  std::array<std::uint8_t, 1U << 16U> piece;  // NOLINT(*-member-init): is written before it is read
  stream_.next_in = block_.data();
  stream_.avail_in = static_cast<uInt>(block_.size());
  do {
    stream_.next_out = piece.data();
    stream_.avail_out = static_cast<uInt>(piece.size());
    ::deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH);
    output.insert(output.end(), piece.data(), stream_.next_out);
  } while (stream_.avail_out == 0);
  if (last) {
    ::deflateReset(&stream_);
  }
}

Decompressor::Decompressor() {
  if (::inflateInit(&stream_) != Z_OK) {
    throw std::bad_alloc();
  }
}

Decompressor::~Decompressor() {
  ::inflateEnd(&stream_);
}

void Decompressor::begin(std::span<const std::uint8_t> input, bool is_empty) {
  require_whole(!is_empty || input.empty());
  ::inflateReset(&stream_);
  stream_.avail_in = 0;
  input_ = input;
}

int Decompressor::expand_some() {
  constexpr std::size_t kMaxInput = std::size_t{1} << 30U;
  if (stream_.avail_in == 0) {
    const auto piece = input_.first(std::min(input_.size(), kMaxInput));
    input_ = input_.subspan(piece.size());
    stream_.next_in = const_cast<std::uint8_t*>(piece.data());
    stream_.avail_in = static_cast<uInt>(piece.size());
  }
  return ::inflate(&stream_, Z_NO_FLUSH);
}

void Decompressor::expand_block(bool last) {
  stream_.next_out = block_.data();
  stream_.avail_out = static_cast<uInt>(block_.size());
  int state = Z_OK;
  while (state == Z_OK && stream_.avail_out > 0) {
    state = expand_some();
  }
  require_whole(stream_.avail_out == 0 && (state == Z_OK || (last && state == Z_STREAM_END)));
  while (last && state == Z_OK) {  // its end, and no more numbers
    std::uint8_t more = 0;
    stream_.next_out = &more;
    stream_.avail_out = 1;
    state = expand_some();
    require_whole(stream_.avail_out == 1);
  }
  require_whole(!last || (state == Z_STREAM_END && stream_.avail_in == 0 && input_.empty()));
}

}  // namespace clca::store
