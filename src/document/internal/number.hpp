#pragma once
// Numbers as documents write them.

#include <optional>
#include <string_view>

namespace clca::document {

inline bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

/// The number that the text is; nothing for other text. For int, std::uint64_t and double.
template <class T>
std::optional<T> number_in(std::string_view text);

}  // namespace clca::document
