#pragma once
// Words for messages: what was found, shortened and made printable, and what was perhaps meant.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace clca::scene {

/// Bytes of the UTF-8 character that begins at `position`; 0 when none does.
std::size_t character_length(std::string_view text, std::size_t position);

/// The character of `length` bytes at `position`, which must be valid.
char32_t character_at(std::string_view text, std::size_t position, std::size_t length);

/// True for the characters that move a terminal's cursor rather than print.
bool is_control(char32_t character);

/// `text` with control characters and invalid bytes written as escapes.
std::string printable(std::string_view text);

/// The beginning of `text`, at most `count` characters.
std::string_view first_characters(std::string_view text, std::size_t count);

/// `text` in single quotes, printable, and cut when it is long.
std::string shown(std::string_view text);

/// `names` with commas between, cut when there are many.
std::string listed(std::span<const std::string_view> names);

/// The name that `text` most likely stands for, if one is near.
std::optional<std::string_view> nearest(std::string_view text,
                                        std::span<const std::string_view> names);

/// `; did you mean 'X'?` or nothing.
std::string suggestion(std::string_view text, std::span<const std::string_view> names);

}  // namespace clca::scene
