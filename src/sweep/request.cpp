// The seeds and varied values of a sweep, from text.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>

#include "clca/scene/units.hpp"
#include "clca/sweep/plan.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"

namespace clca::sweep {

namespace {

constexpr std::string_view kTo = "..";

[[noreturn]] void fail(std::string_view option, std::string_view text, std::string_view message) {
  throw scene::SceneError(fmt::format("{} {}: error: {}", option, text::shortened(text), message));
}

/// First and last of `3` or `1..16`.
std::pair<std::uint64_t, std::uint64_t> seed_range(std::string_view part, std::string_view text) {
  const std::size_t to = part.find(kTo);
  const auto first = text::number<std::uint64_t>(part.substr(0, to));
  const auto last = to == std::string_view::npos
                        ? first
                        : text::number<std::uint64_t>(part.substr(to + kTo.size()));
  if (!first || !last) {
    fail("--seeds", text,
         fmt::format("expected whole numbers from 0 to 18446744073709551615, as in 1..16 or "
                     "1,4,9..12, found {}",
                     text::quoted(part)));
  }
  if (*last < *first) {
    fail("--seeds", text, fmt::format("{} descends; the smaller seed comes first", part));
  }
  return {*first, *last};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

/// The values of YAML text with separators between. Whether brackets and quotes are closed is left
/// to the YAML parser, which has the better message.
std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> values;
  std::size_t start = 0;
  int depth = 0;  // of brackets
  char quote = '\0';
  char before = ' ';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    const bool escaped = quote == '"' && before == '\\';
    // A quote begins quoted text only where a value begins: not in `it's`.
    const bool begins =
        before == separator || std::string_view(" [{,:").find(before) != std::string_view::npos;
    before = escaped ? ' ' : letter;
    if (quote != '\0') {
      if (letter == quote && !escaped) {
        before = quote == '\'' ? ' ' : quote;  // in single quotes '' closes and opens at once
        quote = '\0';
      }
    } else if ((letter == '"' || letter == '\'') && begins) {
      quote = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth;
    } else if (letter == ']' || letter == '}') {
      depth = std::max(0, depth - 1);
    } else if (letter == separator && depth == 0) {
      values.emplace_back(trimmed(text.substr(start, i - start)));
      start = i + 1;
    }
  }
  values.emplace_back(trimmed(text.substr(start)));
  return values;
}

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

/// A number, and the unit of length that may follow.
struct Quantity {
  std::optional<double> number;
  std::string_view unit;
};

Quantity quantity(std::string_view value) {
  value = trimmed(value);
  const bool is_length = scene::metres_in(value).has_value();
  const std::size_t end = is_length ? value.find_last_of("0123456789.") + 1 : value.size();
  return {text::number<double>(value.substr(0, end)), trimmed(value.substr(end))};
}

/// The numbers of a range FIRST:LAST:STEP; nothing of other values.
std::vector<std::string> range_values(std::string_view text, std::string_view value) {
  const std::size_t before_last = value.find(':');
  const std::size_t before_step = value.rfind(':');
  if (before_last == before_step) {
    return {};
  }
  const auto [first, unit] = quantity(value.substr(0, before_last));
  const auto [last, unit_of_last] =
      quantity(value.substr(before_last + 1, before_step - before_last - 1));
  const auto [step, unit_of_step] = quantity(value.substr(before_step + 1));
  if (!first || !last || !step) {
    return {};
  }
  if (unit != unit_of_last || unit != unit_of_step) {
    fail("--vary", text,
         fmt::format("{}: expected FIRST:LAST:STEP in one unit", text::shortened(value)));
  }
  constexpr double kRounding = 1e-9;  // steps like 0.1 have no exact number of steps
  const double steps = std::floor((*last - *first) / *step + kRounding);
  if (!std::isfinite(steps) || steps < 0 || steps >= kMaxRuns) {
    fail("--vary", text,
         fmt::format("{}: expected FIRST:LAST:STEP with a step from the first towards the last, "
                     "and at most {} values",
                     text::shortened(value), kMaxRuns));
  }
  const int digits = std::max(decimals(*first), decimals(*step));
  std::vector<std::string> values;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    values.push_back(
        fmt::format("{}{}{}", rounded(*first + i * *step, digits), unit.empty() ? "" : " ", unit));
  }
  return values;
}

/// Checks that each row has a value per key, and that no two rows are the same.
void check_rows(std::string_view text, const Variation& variation) {
  std::set<std::vector<std::string>> known;
  for (const std::vector<std::string>& row : variation.value_rows) {
    if (std::ranges::count(row, std::string()) > 0) {
      fail("--vary", text, "a value is missing; write none to leave the key out");
    }
    if (row.size() != variation.keys.size()) {
      fail("--vary", text,
           fmt::format("expected {} values with commas between, found {}; a ';' ends them",
                       variation.keys.size(), fmt::join(row, ",")));
    }
  }
  for (const std::vector<std::string>& row : variation.value_rows) {
    std::vector<std::string> values;
    std::ranges::transform(row, std::back_inserter(values), document::canonical_value);
    if (!known.insert(values).second) {
      fail("--vary", text,
           fmt::format("the value {} is named twice",
                       text::shortened(fmt::format("{}", fmt::join(row, ",")))));
    }
  }
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(std::string_view text) {
  std::vector<std::uint64_t> seeds;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const auto [first, last] = seed_range(text.substr(start, comma - start), text);
    if (!seeds.empty() && first <= seeds.back()) {
      fail("--seeds", text,
           fmt::format("{} comes after {}; seeds ascend, each once", first, seeds.back()));
    }
    if (last - first >= kMaxRuns - seeds.size()) {
      fail("--seeds", text, fmt::format("more than {} runs", kMaxRuns));
    }
    for (std::uint64_t i = 0; i <= last - first; ++i) {
      seeds.push_back(first + i);
    }
    start = comma + 1;
  }
  return seeds;
}

std::string to_text(const std::vector<std::uint64_t>& seeds) {
  std::string text;
  for (std::size_t i = 0; i < seeds.size();) {
    std::size_t end = i + 1;
    while (end < seeds.size() && seeds[end] == seeds[end - 1] + 1) {
      ++end;
    }
    text += fmt::format("{}{}", text.empty() ? "" : ",", seeds[i]);
    text += end - i > 1 ? fmt::format("{}{}", kTo, seeds[end - 1]) : "";
    i = end;
  }
  return text;
}

Variation parse_variation(std::string_view text) {
  const std::size_t equals = text.find('=');
  Variation variation = {split(text.substr(0, equals), ','), {}};
  if (equals == std::string_view::npos || std::ranges::count(variation.keys, std::string()) > 0) {
    fail("--vary", text, "expected KEY=V1,V2,... with a key like rules.inertia");
  }
  const bool has_one_key = variation.keys.size() == 1;
  for (const std::string& part : split(text.substr(equals + 1), has_one_key ? ',' : ';')) {
    const auto numbers = has_one_key ? range_values(text, part) : std::vector<std::string>();
    for (const std::string& number : numbers) {
      variation.value_rows.push_back({number});
    }
    if (numbers.empty()) {
      variation.value_rows.push_back(has_one_key ? std::vector{part} : split(part, ','));
    }
  }
  check_rows(text, variation);
  return variation;
}

}  // namespace clca::sweep
