#pragma once
// Text for messages: found values, shortened and printable, and suggestions.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clca::text {

/// True for the characters that move a terminal's cursor rather than print.
bool is_control_character(char32_t character);

/// `text` with control characters and invalid bytes written as escapes.
std::string printable(std::string_view text);

/// The beginning of `text`, at most `count` characters.
std::string_view first_characters(std::string_view text, std::size_t count);

/// `text`, printable, without what exceeds `count` characters.
std::string shortened(std::string_view text, std::size_t count = 120);

/// `text` in single quotes, printable, shortened if long.
std::string quoted(std::string_view text);

/// `path` for a command line: quoted where necessary, after `./` if it begins with `-`.
std::string shell_word(std::string_view path);

/// `names` separated by commas, shortened if many.
std::string comma_separated(std::span<const std::string_view> names);

/// The name closest to `text`, if one is close.
std::optional<std::string_view> nearest_name(std::string_view text,
                                             std::span<const std::string_view> names);

/// `; did you mean 'X'?` or nothing.
std::string suggestion(std::string_view text, std::span<const std::string_view> names);

/// The names of things that have one. `Text` is std::string_view (into the things) or std::string.
template <class Text = std::string_view, class Things>
std::vector<Text> names_of(const Things& things) {
  std::vector<Text> names;
  for (const auto& thing : things) {
    names.emplace_back(thing.name);
  }
  return names;
}

}  // namespace clca::text
