#include "document/internal/source_text.hpp"

#include <algorithm>

#include "clca/document/document.hpp"
#include "clca/text/message.hpp"
#include "clca/text/utf8.hpp"

namespace clca::document {

namespace {

constexpr std::size_t kBlock = 1024;

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80;  // not the middle of one
  }));
}

}  // namespace

SourceText::SourceText(std::string_view text, std::shared_ptr<const Origin> origin)
    : text_(text), origin_(std::move(origin)) {
  if (text_.size() > kMaxBytes) {
    fail({origin_, 1, 1}, "the text is larger than {} MiB", kMaxBytes >> 20U);
  }
  characters_ = {0};
  for (std::size_t i = 0; i + kBlock <= text_.size(); i += kBlock) {
    characters_.push_back(characters_.back() + count_characters(text_.substr(i, kBlock)));
  }
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') {
      line_starts_.push_back(i + 1);
    }
  }
  check_characters();
  check_directives();
  check_brackets();
}

TextLocation SourceText::location(std::size_t position) const {
  const std::size_t end = std::min(position, text_.size());
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), end);
  const auto line = static_cast<std::size_t>(next - line_starts_.begin());
  return {origin_, line, characters_before(end) - characters_before(line_starts_[line - 1]) + 1};
}

std::size_t SourceText::characters_before(std::size_t position) const {
  const std::size_t block = position / kBlock;
  return characters_[block] +
         count_characters(text_.substr(block * kBlock, position - block * kBlock));
}

void SourceText::check_character(std::size_t position, std::size_t length) const {
  if (length == 0) {
    fail(location(position), "the byte 0x{:02x} is not UTF-8 text",
         static_cast<unsigned char>(text_[position]));
  }
  const char32_t character = text::character_at(text_, position);
  if (position == 0 && character == 0xFEFF) {
    fail(location(0), "a byte order mark; save the file as UTF-8 without it");
  }
  const bool line_end = text_.substr(position, 2) == "\r\n";
  if (text::is_control(character) && character != '\n' && character != '\t' && !line_end) {
    fail(location(position), "the control character U+{:04X} is not allowed",
         static_cast<unsigned>(character));
  }
}

void SourceText::check_characters() const {
  bool comment = false;
  for (std::size_t i = 0; i < text_.size();) {
    const std::size_t length = text::character_length(text_, i);
    check_character(i, length);
    if (text_[i] == '\t' && !comment) {
      fail(location(i), "a tab; indent and align with spaces");
    }
    comment = text_[i] != '\n' && (comment || text_[i] == '#');
    i += length;
  }
}

void SourceText::check_directives() const {
  for (const std::size_t start : line_starts_) {
    const std::string_view rest = text_.substr(start);
    if (rest.starts_with('%')) {
      fail(location(start), "YAML directives ('%') are not part of the format");
    }
    const std::size_t first = std::min(rest.find_first_not_of(" \r"), rest.size());
    if (first < rest.size() && rest[first] != '\n' && rest[first] != '#') {
      return;
    }
  }
}

// yaml-cpp keeps all of a value in brackets in memory before it hands on the first of it: some 200
// bytes a value. A value follows a comma, a colon, a bracket or the dash of a list.
void SourceText::check_brackets() const {
  constexpr std::string_view kBeforeValue = "\n:,-?[{";
  std::size_t depth = 0;
  std::size_t values = 0;
  char before = '\n';  // the last character that is no space
  for (std::size_t i = 0; i < text_.size(); ++i) {
    const char letter = text_[i];
    const bool begins = kBeforeValue.find(before) != std::string_view::npos;
    if (letter == '#' && (i == 0 || text_[i - 1] == ' ' || text_[i - 1] == '\n')) {
      i = std::min(text_.find('\n', i), text_.size()) - 1;
    } else if (begins && (letter == '"' || letter == '\'')) {
      i = end_of_quote(i);
      before = letter;
    } else if (letter != ' ' && letter != '\r') {
      const bool opens = letter == '[' || letter == '{';
      if (opens && begins && ++depth > kMaxDepth) {
        fail(location(i), "nested deeper than {} levels", kMaxDepth);
      }
      depth -= (letter == ']' || letter == '}') && depth > 0 ? 1 : 0;
      before = opens && !begins ? 'a' : letter;  // in the middle of a text it is a letter
      const bool dash =
          letter == '-' && (text_.substr(i, 2) == "- " || text_.substr(i, 2) == "-\n");
      values += opens || dash || letter == ',' || letter == ':' || letter == '?' ? 1 : 0;
      if (values > kMaxValues) {
        fail(location(i), "more than {} values", kMaxValues);
      }
    }
  }
}

std::size_t SourceText::end_of_quote(std::size_t begin) const {
  const char quote = text_[begin];
  for (std::size_t i = begin + 1; i < text_.size(); ++i) {
    const bool is_doubled = quote == '\'' && text_.substr(i, 2) == "''";  // a quote inside quotes
    if (text_[i] == quote && !is_doubled) {
      return i;
    }
    i += is_doubled || (quote == '"' && text_[i] == '\\') ? 1 : 0;
  }
  return text_.size();
}

}  // namespace clca::document
