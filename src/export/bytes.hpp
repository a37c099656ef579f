#pragma once
// Numbers as bytes in machine order; both binary formats expect little-endian.

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace clca::exports {

static_assert(std::endian::native == std::endian::little);

using Bytes = std::vector<std::uint8_t>;

template <class T>
void append(Bytes& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// As three floats.
inline void append_vector(Bytes& bytes, double x, double y) {
  append(bytes, static_cast<float>(x));
  append(bytes, static_cast<float>(y));
  append(bytes, 0.0F);
}

/// The bytes of one number or plain struct.
template <class T>
Bytes bytes_of(const T& value) {
  Bytes bytes;
  append(bytes, value);
  return bytes;
}

}  // namespace clca::exports
