#include "render/utf8.hpp"

#include <array>

namespace clca::render {

namespace {

/// Length of a sequence by its first byte; 0 for a byte that cannot come first.
unsigned sequence_length(unsigned lead) {
  if (lead < 0x80U) {
    return 1;
  }
  if (lead >= 0xC2U && lead < 0xE0U) {
    return 2;
  }
  if (lead >= 0xE0U && lead < 0xF0U) {
    return 3;
  }
  return lead >= 0xF0U && lead < 0xF5U ? 4 : 0;
}

/// The code point of a whole sequence, or U+FFFD.
char32_t code_point(std::string_view sequence) {
  constexpr std::array<unsigned, 5> kLeadBits = {0, 0x7F, 0x1F, 0x0F, 0x07};
  constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  char32_t value = static_cast<unsigned char>(sequence.front()) & kLeadBits[sequence.size()];
  for (const char byte : sequence.substr(1)) {
    const unsigned bits = static_cast<unsigned char>(byte);
    if ((bits & 0xC0U) != 0x80U) {
      return kReplacement;
    }
    value = (value << 6U) | (bits & 0x3FU);
  }
  const bool surrogate = value >= 0xD800 && value < 0xE000;
  return value < kLeast[sequence.size()] || value > 0x10FFFF || surrogate ? kReplacement : value;
}

}  // namespace

std::u32string decode_utf8(std::string_view text) {
  std::u32string result;
  while (!text.empty()) {
    std::size_t length = sequence_length(static_cast<unsigned char>(text.front()));
    char32_t value = kReplacement;
    if (length > 0 && length <= text.size()) {
      value = code_point(text.substr(0, length));
    }
    if (value == kReplacement && text.substr(0, 3) != "\xEF\xBF\xBD") {
      length = 1;
    }
    result.push_back(value);
    text.remove_prefix(length);
  }
  return result;
}

std::string encode_utf8(std::u32string_view text) {
  std::string result;
  const auto add = [&](char32_t value) { result.push_back(static_cast<char>(value)); };
  for (const char32_t value : text) {
    if (value < 0x80) {
      add(value);
      continue;
    }
    if (value < 0x800) {
      add(0xC0U | (value >> 6U));
    } else {
      if (value < 0x10000) {
        add(0xE0U | (value >> 12U));
      } else {
        add(0xF0U | (value >> 18U));
        add(0x80U | ((value >> 12U) & 0x3FU));
      }
      add(0x80U | ((value >> 6U) & 0x3FU));
    }
    add(0x80U | (value & 0x3FU));
  }
  return result;
}

}  // namespace clca::render
