// KEY=V1,V2,... to the values that a key takes.

#include <fmt/format.h>

#include <algorithm>

#include "clca/sweep/request.hpp"

namespace clca::sweep {

namespace {

[[noreturn]] void fail_variation(std::string_view text, std::string_view message) {
  throw scene::SceneError(fmt::format("--vary {}: error: {}", text, message));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// Walks over YAML text and knows which commas stand between values. Whether brackets and quotes
/// are closed is left to the YAML parser, which has the better message.
class Splitter {
 public:
  /// True when `letter`, the next one, ends a value.
  bool ends_value(char letter) {
    if (quote_ != '\0') {
      inside_quotes(letter);
      return false;
    }
    // A quote begins quoted text only where a value begins: not in `it's`.
    const bool at_start = std::string_view(" [{,:").find(previous_) != std::string_view::npos;
    if ((letter == '"' || letter == '\'') && at_start) {
      quote_ = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth_;
    } else if (letter == ']' || letter == '}') {
      depth_ = std::max(0, depth_ - 1);
    }
    previous_ = letter;
    return letter == ',' && depth_ == 0;
  }

 private:
  void inside_quotes(char letter) {
    const bool escaped = quote_ == '"' && previous_ == '\\';
    // In single quotes '' is a quote; it closes and opens at once.
    previous_ = escaped ? ' ' : letter;
    if (letter == quote_ && !escaped) {
      previous_ = quote_ == '\'' ? ' ' : letter;
      quote_ = '\0';
    }
  }

  char quote_ = '\0';
  char previous_ = ' ';
  int depth_ = 0;
};

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> values;
  Splitter splitter;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (splitter.ends_value(text[i])) {
      values.emplace_back(trimmed(text.substr(start, i - start)));
      start = i + 1;
    }
  }
  values.emplace_back(trimmed(text.substr(start)));
  return values;
}

}  // namespace

Variation parse_variation(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || trimmed(text.substr(0, equals)).empty()) {
    fail_variation(text, "expected KEY=V1,V2,... with a key like rules.inertia");
  }
  Variation variation = {std::string(trimmed(text.substr(0, equals))),
                         split(text.substr(equals + 1))};
  std::vector<std::string> sorted = variation.values;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.front().empty()) {
    fail_variation(text, "a value is missing; write null for an empty value");
  }
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    fail_variation(text, fmt::format("the value {} is named twice", *twice));
  }
  return variation;
}

}  // namespace clca::sweep
