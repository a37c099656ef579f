// KEY=V1,V2,... to the values that keys take.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>

#include "clca/sweep/request.hpp"
#include "clca/text/message.hpp"

namespace clca::sweep {

namespace {

[[noreturn]] void fail_variation(std::string_view text, std::string_view message) {
  throw scene::SceneError(fmt::format("--vary {}: error: {}", text::shortened(text), message));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// Walks over YAML text and knows which separators stand between values. Whether brackets and
/// quotes are closed is left to the YAML parser, which has the better message.
class Splitter {
 public:
  explicit Splitter(char separator) : separator_(separator) {}

  /// True when `letter`, the next one, ends a value.
  bool ends_value(char letter) {
    if (quote_ != '\0') {
      inside_quotes(letter);
      return false;
    }
    // A quote begins quoted text only where a value begins: not in `it's`.
    const bool at_start = previous_ == separator_ ||
                          std::string_view(" [{,:").find(previous_) != std::string_view::npos;
    if ((letter == '"' || letter == '\'') && at_start) {
      quote_ = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth_;
    } else if (letter == ']' || letter == '}') {
      depth_ = std::max(0, depth_ - 1);
    }
    previous_ = letter;
    return letter == separator_ && depth_ == 0;
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

  char separator_;
  char quote_ = '\0';
  char previous_ = ' ';
  int depth_ = 0;
};

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> values;
  Splitter splitter(separator);
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

/// Decimals of the number.
int decimals(double number) {
  std::array<char, 32> buffer = {};  // as 1.25e-03
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                          std::chars_format::scientific);
  const std::string text(buffer.data(), end);
  const std::size_t exponent = text.find('e');
  const std::size_t point = std::min(text.find('.') + 1, exponent);
  const auto behind = static_cast<int>(point > 0 ? exponent - point : 0);
  return std::max(0, behind - std::stoi(text.substr(exponent + 1)));
}

/// Without zeros at the end, and without an exponent.
std::string rounded(double number, int digits) {
  std::string text = fmt::format("{:.{}f}", number, digits);
  if (digits > 0) {
    text.erase(text.find_last_not_of('0') + 1);
    text.erase(text.find_last_not_of('.') + 1);
  }
  return text == "-0" ? "0" : text;
}

/// The numbers of a range FIRST:LAST:STEP; nothing of other values.
std::vector<std::string> range_values(std::string_view text, std::string_view value) {
  std::array<double, 3> parts = {};
  const char* at = value.data();
  const char* const end = at + value.size();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [stop, error] = std::from_chars(at, end, parts[i]);
    const bool last = i + 1 == parts.size();
    if (error != std::errc() || (last ? stop != end : stop == end || *stop != ':')) {
      return {};
    }
    at = last ? stop : stop + 1;
  }
  const auto [first, last, step] = parts;
  constexpr double kRounding = 1e-9;  // steps like 0.1 have no exact number of steps
  const double steps = std::floor((last - first) / step + kRounding);
  if (!std::isfinite(steps) || steps < 0 || steps >= kMaxRuns) {
    fail_variation(
        text,
        fmt::format("{}: expected FIRST:LAST:STEP with a step from the first towards the last, "
                    "and at most {} values",
                    text::shortened(value), kMaxRuns));
  }
  const int digits = std::max(decimals(first), decimals(step));
  std::vector<std::string> values;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    values.push_back(rounded(first + i * step, digits));
  }
  return values;
}

}  // namespace

Variation parse_variation(std::string_view text) {
  const std::size_t equals = text.find('=');
  Variation variation = {split(text.substr(0, equals), ','), {}};
  const auto is_empty = [](const std::string& part) { return part.empty(); };
  const std::vector<std::string>& keys = variation.keys;
  if (equals == std::string_view::npos || std::any_of(keys.begin(), keys.end(), is_empty)) {
    fail_variation(text, "expected KEY=V1,V2,... with a key like rules.inertia");
  }
  for (const std::string& part : split(text.substr(equals + 1), keys.size() == 1 ? ',' : ';')) {
    const auto numbers = keys.size() == 1 ? range_values(text, part) : std::vector<std::string>();
    for (const std::string& number : numbers) {
      variation.rows.push_back({number});
    }
    if (numbers.empty()) {
      variation.rows.push_back(keys.size() == 1 ? std::vector{part} : split(part, ','));
    }
  }
  for (const std::vector<std::string>& row : variation.rows) {
    if (std::any_of(row.begin(), row.end(), is_empty)) {
      fail_variation(text, "a value is missing; write null for an empty value");
    }
    if (row.size() != keys.size()) {
      fail_variation(
          text, fmt::format("expected {} values with commas between, found {}; a ';' ends them",
                            keys.size(), fmt::join(row, ",")));
    }
  }
  std::set<std::vector<std::string>> known;
  for (const std::vector<std::string>& row : variation.rows) {
    std::vector<std::string> values;
    std::transform(row.begin(), row.end(), std::back_inserter(values), scene::canonical_value);
    if (!known.insert(values).second) {
      fail_variation(text, fmt::format("the value {} is named twice",
                                       text::shortened(fmt::format("{}", fmt::join(row, ",")))));
    }
  }
  return variation;
}

}  // namespace clca::sweep
