#include "document/internal/number.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "clca/text/number.hpp"

namespace clca::document {

namespace {

/// Digits without a superfluous zero in front, which elsewhere would mean octal.
bool is_plain_integer(std::string_view text) {
  if (text.starts_with('-')) {
    text.remove_prefix(1);
  }
  return !text.empty() && std::ranges::all_of(text, is_digit) &&
         (text.size() == 1 || text.front() != '0');
}

/// The same with a fraction and an exponent; std::from_chars checks the rest.
bool is_plain_number(std::string_view text) {
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(text.find_first_of(".eE"), text.size());
  const std::string_view whole = text.substr(sign, end - sign);
  const bool fraction = end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1]);
  return is_plain_integer(whole) || (whole.empty() && fraction);
}

}  // namespace

template <class T>
std::optional<T> number_in(std::string_view text) {
  const bool plain = std::is_integral_v<T> ? is_plain_integer(text) : is_plain_number(text);
  return plain ? text::number<T>(text) : std::nullopt;
}

template std::optional<int> number_in(std::string_view text);
template std::optional<std::uint64_t> number_in(std::string_view text);
template std::optional<double> number_in(std::string_view text);

}  // namespace clca::document
