#include "clca/text/utf8.hpp"

#include <utf8.h>

namespace clca::text {

std::size_t character_bytes(std::string_view text, std::size_t position) {
  const char* const begin = text.data() + position;
  const char* end = begin;
  try {
    utf8::next(end, text.data() + text.size());
    return static_cast<std::size_t>(end - begin);
  } catch (const utf8::exception&) {
    return 0;
  }
}

char32_t character_at(std::string_view text, std::size_t position) {
  return utf8::peek_next(text.data() + position, text.data() + text.size());
}

std::u32string decode_utf8(std::string_view text) {
  std::u32string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_bytes(text, i);
    result.push_back(length == 0 ? kReplacementCharacter : character_at(text, i));
    i += length == 0 ? 1 : length;
  }
  return result;
}

std::string encode_utf8(std::u32string_view text) {
  return utf8::utf32to8(text);
}

}  // namespace clca::text
