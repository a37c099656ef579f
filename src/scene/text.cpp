#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "scene/limits.hpp"

namespace clca::scene {

namespace {

constexpr std::size_t kShownCharacters = 40;
constexpr std::size_t kListedNames = 16;

unsigned byte_at(std::string_view text, std::size_t position) {
  return static_cast<unsigned char>(text[position]);
}

/// Bytes that the first byte of a character asks for; 0 when it cannot be a first byte.
std::size_t announced_length(unsigned first) {
  if (first < 0x80) {
    return 1;
  }
  if (first >= 0xC2 && first < 0xE0) {
    return 2;
  }
  if (first >= 0xE0 && first < 0xF0) {
    return 3;
  }
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

char lowered(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// Letters to change, insert, leave out or swap with their neighbour to make `a` of `b`.
std::size_t edits(std::string_view a, std::string_view b) {
  std::array<std::vector<std::size_t>, 3> rows;  // the one before the last, the last, this one
  rows.fill(std::vector<std::size_t>(b.size() + 1));
  for (std::size_t j = 0; j <= b.size(); ++j) {
    rows[1][j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    rows[2][0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lowered(a[i - 1]) == lowered(b[j - 1]);
      rows[2][j] =
          std::min({rows[1][j] + 1, rows[2][j - 1] + 1, rows[1][j - 1] + (same ? 0U : 1U)});
      if (i > 1 && j > 1 && lowered(a[i - 1]) == lowered(b[j - 2]) &&
          lowered(a[i - 2]) == lowered(b[j - 1])) {
        rows[2][j] = std::min(rows[2][j], rows[0][j - 2] + 1);
      }
    }
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  }
  return rows[1][b.size()];
}

}  // namespace

std::size_t character_length(std::string_view text, std::size_t position) {
  const std::size_t length = announced_length(byte_at(text, position));
  if (length == 0 || length > text.size() - position) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, position + i) & 0xC0U) != 0x80) {
      return 0;
    }
  }
  constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const char32_t character = character_at(text, position, length);
  const bool surrogate = character >= 0xD800 && character < 0xE000;
  return character < kLeast[length] || character > 0x10FFFF || surrogate ? 0 : length;
}

char32_t character_at(std::string_view text, std::size_t position, std::size_t length) {
  constexpr std::array<unsigned, 5> kFirstBits = {0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t character = byte_at(text, position) & kFirstBits[length];
  for (std::size_t i = 1; i < length; ++i) {
    character = character << 6U | (byte_at(text, position + i) & 0x3FU);
  }
  return character;
}

bool is_control(char32_t character) {
  return character < 0x20 || (character >= 0x7F && character < 0xA0) || character == 0x2028 ||
         character == 0x2029;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0) {
      result += fmt::format("\\x{:02x}", byte_at(text, i));
    } else if (const char32_t character = character_at(text, i, length); character == '\n') {
      result += "\\n";
    } else if (is_control(character)) {
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
    end += std::max<std::size_t>(character_length(text, end), 1);
  }
  return text.substr(0, end);
}

std::string shown(std::string_view text) {
  const std::string_view start = first_characters(text, kShownCharacters);
  return fmt::format("'{}{}'", printable(start), start.size() < text.size() ? "..." : "");
}

std::string listed(std::span<const std::string_view> names) {
  const auto first = names.first(std::min(names.size(), kListedNames));
  return fmt::format("{}{}", fmt::join(first, ", "), first.size() < names.size() ? ", ..." : "");
}

std::optional<std::string_view> nearest(std::string_view text,
                                        std::span<const std::string_view> names) {
  std::optional<std::string_view> best;
  std::size_t least = 0;
  for (const std::string_view name : names) {
    const std::size_t longer = std::max(text.size(), name.size());
    if (longer > kLongestName) {
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
  const auto name = nearest(text, names);
  return name ? fmt::format("; did you mean '{}'?", printable(*name)) : "";
}

}  // namespace clca::scene
