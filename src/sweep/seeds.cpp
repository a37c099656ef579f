// Seeds as text, and back.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "clca/sweep/request.hpp"
#include "clca/text/message.hpp"

namespace clca::sweep {

namespace {

constexpr std::string_view kTo = "..";

struct Range {
  std::uint64_t first = 0;
  std::uint64_t last = 0;  // inclusive
};

[[noreturn]] void fail_seeds(std::string_view text, const std::string& message) {
  throw scene::SceneError(fmt::format("--seeds {}: error: {}", text::shortened(text), message));
}

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return stop == end && error == std::errc() ? std::optional(value) : std::nullopt;
}

/// `3` or `1..16`.
Range range(std::string_view part, std::string_view text) {
  const std::size_t to = part.find(kTo);
  const auto first = number(part.substr(0, to));
  const auto last = to == std::string_view::npos ? first : number(part.substr(to + kTo.size()));
  if (!first || !last) {
    fail_seeds(text,
               fmt::format("expected whole numbers from 0 to 18446744073709551615, as in 1..16 or "
                           "1,4,9..12, found {}",
                           text::shown(part)));
  }
  if (*last < *first) {
    fail_seeds(text, fmt::format("{} descends; the smaller seed comes first", part));
  }
  if (*last - *first >= kMaxRuns) {
    fail_seeds(text, fmt::format("more than {} runs", kMaxRuns));
  }
  return {*first, *last};
}

void append(std::vector<std::uint64_t>& seeds, Range range, std::string_view text) {
  if (!seeds.empty() && range.first <= seeds.back()) {
    fail_seeds(
        text, fmt::format("{} comes after {}; seeds ascend, each once", range.first, seeds.back()));
  }
  const std::uint64_t count = range.last - range.first + 1;
  if (seeds.size() + count > kMaxRuns) {
    fail_seeds(text, fmt::format("more than {} runs", kMaxRuns));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    seeds.push_back(range.first + i);
  }
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(std::string_view text) {
  std::vector<std::uint64_t> seeds;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    append(seeds, range(text.substr(start, comma - start), text), text);
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

}  // namespace clca::sweep
