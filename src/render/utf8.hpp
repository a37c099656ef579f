#pragma once
// Text as Unicode code points.

#include <cstdint>
#include <string>
#include <string_view>

namespace clca::render {

inline constexpr char32_t kReplacement = 0xFFFD;

/// Bytes that are no UTF-8 become U+FFFD, one a byte.
std::u32string decode_utf8(std::string_view text);

std::string encode_utf8(std::u32string_view text);

}  // namespace clca::render
