#include "clca/text/message.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/text/utf8.hpp"

namespace clca::text {

namespace {

constexpr std::size_t kShownCharacters = 40;
constexpr std::size_t kListedNames = 16;
constexpr std::size_t kLongestGuess = 64;  // characters; longer names resemble nothing

char lowered(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// Letters to change, insert, leave out or swap with their neighbour to make `a` of `b`.
std::size_t edits(std::string_view a, std::string_view b) {
  // Edit distances between the first i letters of `a` and the first j letters of `b`.
  std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        least[i][j] = i + j;
        continue;
      }
      const bool same = lowered(a[i - 1]) == lowered(b[j - 1]);
      least[i][j] = std::min(
          {least[i - 1][j] + 1, least[i][j - 1] + 1, least[i - 1][j - 1] + (same ? 0U : 1U)});
      if (i > 1 && j > 1 && lowered(a[i - 1]) == lowered(b[j - 2]) &&
          lowered(a[i - 2]) == lowered(b[j - 1])) {
        least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
      }
    }
  }
  return least[a.size()][b.size()];
}

}  // namespace

bool is_control_character(char32_t character) {
  return character < 0x20 || (character >= 0x7F && character < 0xA0) || character == 0x2028 ||
         character == 0x2029 || (character & 0xFFFE) == 0xFFFE;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_bytes(text, i);
    if (length == 0) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
    } else if (const char32_t character = character_at(text, i); character == '\n') {
      result += "\\n";
    } else if (is_control_character(character)) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(character));
    } else {
      result += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

std::string_view first_characters(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t i = 0; end < text.size() && i < count; ++i) {
    end += std::max<std::size_t>(character_bytes(text, end), 1);
  }
  return text.substr(0, end);
}

std::string shortened(std::string_view text, std::size_t count) {
  const std::string_view start = first_characters(text, count);
  return printable(start) + (start.size() < text.size() ? "..." : "");
}

std::string quoted(std::string_view text) {
  return fmt::format("'{}'", shortened(text, kShownCharacters));
}

std::string shell_word(std::string_view path) {
  constexpr std::string_view kPlain =
      "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_-+./";
  std::string word = (path.starts_with('-') ? "./" : "") + std::string(path);
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
    return word;
  }
  std::string quoted = "'";
  for (const char letter : word) {
    quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  }
  return quoted + "'";
}

std::string comma_separated(std::span<const std::string_view> names) {
  const auto first = names.first(std::min(names.size(), kListedNames));
  return fmt::format("{}{}", fmt::join(first, ", "), first.size() < names.size() ? ", ..." : "");
}

std::optional<std::string_view> nearest_name(std::string_view text,
                                             std::span<const std::string_view> names) {
  std::optional<std::string_view> best;
  std::size_t least = 0;
  for (const std::string_view name : names) {
    const std::size_t longer = std::max(text.size(), name.size());
    if (longer > kLongestGuess) {
      continue;
    }
    const std::size_t distance = edits(text, name);
    const bool near = distance <= (longer + 2) / 3 && distance < std::min(text.size(), name.size());
    if (near && (!best || distance < least)) {
      best = name;
      least = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view text, std::span<const std::string_view> names) {
  const auto name = nearest_name(text, names);
  return name ? fmt::format("; did you mean '{}'?", printable(*name)) : "";
}

}  // namespace clca::text
