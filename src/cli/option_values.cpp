#include "cli/option_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "clca/scene/format.hpp"
#include "clca/text/message.hpp"

namespace clca::cli {

namespace {

/// A number that begins with a digit, and what follows it.
template <class T>
struct Quantity {
  T number = 0;
  std::string_view unit;
};

template <class T>
std::optional<Quantity<T>> quantity(std::string_view text) {
  Quantity<T> result;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, result.number);
  if (text.empty() || text.front() < '0' || text.front() > '9' || error != std::errc()) {
    return std::nullopt;
  }
  result.unit = text.substr(static_cast<std::size_t>(stop - text.data()));
  return result;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return text;
}

/// Seconds.
std::optional<double> time_unit(std::string_view unit) {
  if (unit.empty() || unit == "s") {
    return 1;
  }
  return unit == "min" ? std::optional(60.0) : unit == "h" ? std::optional(3600.0) : std::nullopt;
}

/// Bytes of `k`, `KB`, `KiB` and so on, all of 1024.
std::optional<double> size_unit(std::string unit) {
  unit = lowered(unit);
  if (unit.empty() || unit == "b") {
    return 1;
  }
  const std::size_t power = std::string_view("kmgtpe").find(unit.front());
  const std::string rest = unit.substr(1);
  const bool is_known = rest.empty() || rest == "b" || rest == "i" || rest == "ib";
  return power != std::string_view::npos && is_known
             ? std::optional(std::exp2(10 * static_cast<double>(power + 1)))
             : std::nullopt;
}

std::string expected(std::string_view what, const std::string& text) {
  return fmt::format("expected {}, found {}", what, text::shown(text));
}

std::string accept(std::string& /*text*/) {
  return {};
}

std::vector<Candidate> candidates_of(const std::vector<std::string>& words,
                                     const std::string& before = "") {
  std::vector<Candidate> candidates;
  for (const std::string& word : words) {
    candidates.push_back({before + word});
  }
  return candidates;
}

std::string in_braces(const std::vector<std::string>& words) {
  return fmt::format("{{{}}}", fmt::join(words, ","));
}

std::vector<Candidate> keys(const std::string& begun, const std::string& after_last) {
  std::vector<Candidate> candidates;
  for (const scene::KeyName& key : scene::keys_beginning(begun)) {
    if (key.has_keys) {
      candidates.push_back({key.path + ".", key.about});
    }
    if (!key.has_keys || !scene::words_of(key.path).empty()) {
      candidates.push_back({key.path + after_last, key.about});
    }
  }
  return candidates;
}

/// `KEY=`, and after it the words that the key may have; several are separated by commas.
std::vector<Candidate> assignments(const std::string& begun) {
  const std::size_t equals = begun.find('=');
  if (equals == std::string::npos) {
    return keys(begun, "=");
  }
  const std::size_t last = begun.find_last_of("=,");
  return candidates_of(scene::words_of(begun.substr(0, equals)), begun.substr(0, last + 1));
}

}  // namespace

OptionValues whole_number(std::uint64_t least, std::uint64_t most) {
  const auto check = [least, most](std::string& text) -> std::string {
    const auto found = quantity<std::uint64_t>(text);
    const bool is_plain = found && found->unit.empty() && (text.size() == 1 || text.front() != '0');
    return is_plain && found->number >= least && found->number <= most
               ? std::string()
               : expected(fmt::format("a whole number from {} to {}", least, most), text);
  };
  const bool is_any = least == 0 && most == std::numeric_limits<std::uint64_t>::max();
  return {check, is_any ? std::string() : fmt::format("in [{} - {}]", least, most)};
}

OptionValues length_of_figure() {
  const auto check = [](std::string& text) -> std::string {
    const auto found = quantity<std::uint64_t>(text);
    const bool is_mm = found && found->unit == "mm";
    const bool is_length = found && (is_mm || found->unit.empty()) && text.front() != '0' &&
                           found->number >= (is_mm ? 20 : 100) &&
                           found->number <= (is_mm ? 1000 : 10'000);
    return is_length
               ? std::string()
               : expected("a whole number of pixels from 100 to 10000, or 20mm to 1000mm", text);
  };
  return {check, "in [100 - 10000] or [20mm - 1000mm]"};
}

OptionValues finite_number() {
  const auto check = [](std::string& text) -> std::string {
    const bool is_negative = text.starts_with('-');
    const auto found = quantity<double>(std::string_view(text).substr(is_negative ? 1 : 0));
    return found && found->unit.empty() ? std::string() : expected("a number", text);
  };
  return {check, ""};
}

OptionValues limits_of_axis() {
  const auto check = [](std::string& text) -> std::string {
    const std::size_t colon = text.find(':');
    std::string low = text.substr(0, colon);
    std::string high = colon < text.size() ? text.substr(colon + 1) : "";
    const OptionValues number = finite_number();
    const bool is_right = colon < text.size() && text.size() > 1 &&
                          (low.empty() || number.read(low).empty()) &&
                          (high.empty() || number.read(high).empty());
    return is_right ? std::string() : expected("two numbers, as 0:5 or :5", text);
  };
  return {check, ""};
}

OptionValues part_of_whole(std::uint64_t most) {
  const auto check = [most](std::string& text) -> std::string {
    const std::size_t slash = text.find('/');
    const auto number = quantity<std::uint64_t>(text.substr(0, slash));
    const auto of = quantity<std::uint64_t>(slash < text.size() ? text.substr(slash + 1) : "");
    const bool is_plain = number && of && number->unit.empty() && of->unit.empty() &&
                          text == fmt::format("{}/{}", number->number, of->number);
    return is_plain && number->number >= 1 && number->number <= of->number && of->number <= most
               ? std::string()
               : expected(fmt::format("K/N with K from 1 to N and N up to {}", most), text);
  };
  return {check, ""};
}

OptionValues key_of_scene() {
  return {accept, "", [](const std::string& begun) { return keys(begun, ""); }};
}

OptionValues value_of_key(const std::string& key) {
  const std::vector<std::string> words = scene::words_of(key);
  return {accept, words.empty() ? "" : in_braces(words),
          [words](const std::string& /*begun*/) { return candidates_of(words); }};
}

OptionValues assignment(const std::string& form) {
  const auto check = [form](std::string& text) -> std::string {
    return text.find('=') == std::string::npos ? expected(form + ", as in rules.inertia=0.5", text)
                                               : std::string();
  };
  return {check, "", assignments};
}

OptionValues time_span() {
  const auto convert = [](std::string& text) -> std::string {
    constexpr double kMaxSeconds = 1e9;
    const auto found = quantity<double>(text);
    const auto unit = found ? time_unit(found->unit) : std::nullopt;
    if (!unit || found->number * *unit > kMaxSeconds) {
      return expected("a time up to 1e9 seconds, as in 90, 30min or 2h", text);
    }
    text = fmt::format("{}", found->number * *unit);
    return {};
  };
  return {convert, ""};
}

OptionValues byte_size() {
  const auto convert = [](std::string& text) -> std::string {
    constexpr double kMaxBytes = 0x1p62;
    const auto found = quantity<std::uint64_t>(text);
    const auto unit = found ? size_unit(std::string(found->unit)) : std::nullopt;
    const double bytes = unit ? static_cast<double>(found->number) * *unit : 0;
    if (bytes < 1 || bytes > kMaxBytes) {
      return expected("a size from 1 to 4EiB, as in 512MiB or 4GiB", text);
    }
    text = fmt::format("{}", static_cast<std::uint64_t>(bytes));
    return {};
  };
  return {convert, ""};
}

OptionValues one_of(const std::vector<std::string>& words, LetterCase letter_case) {
  const std::string shown = in_braces(words);
  const auto convert = [words, letter_case, shown](std::string& text) -> std::string {
    const auto word = std::find_if(words.begin(), words.end(), [&](const std::string& known) {
      return letter_case == LetterCase::matters ? known == text : lowered(known) == lowered(text);
    });
    if (word == words.end()) {
      return fmt::format("{} not in {}", text, shown);
    }
    text = *word;
    return {};
  };
  return {convert, shown, [words](const std::string& /*begun*/) { return candidates_of(words); }};
}

}  // namespace clca::cli
