#pragma once
// Numbers in text.

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace clca::text {

/// The number that the whole text is, as std::from_chars reads it; none if it is none. `format`:
/// further arguments of that function.
template <class T>
std::optional<T> number(std::string_view text, auto... format) {
  T result = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, result, format...);
  return stop == end && error == std::errc() ? std::optional(result) : std::nullopt;
}

}  // namespace clca::text
