#pragma once
// Text as Unicode code points.

#include <cstddef>
#include <string>
#include <string_view>

namespace clca::text {

inline constexpr char32_t kReplacementCharacter = 0xFFFD;

/// Bytes of the UTF-8 character that begins at `position`; 0 when none does.
std::size_t character_bytes(std::string_view text, std::size_t position);

/// The character at `position`, which must be valid.
char32_t character_at(std::string_view text, std::size_t position);

/// Each invalid byte becomes U+FFFD.
std::u32string decode_utf8(std::string_view text);

std::string encode_utf8(std::u32string_view text);

}  // namespace clca::text
