#include "cli/option_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
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

/// One without a sign or leading zeros, in this range.
bool is_whole(std::string_view text, std::uint64_t least, std::uint64_t most) {
  const auto found = quantity<std::uint64_t>(text);
  return found && found->unit.empty() && (text.size() == 1 || text.front() != '0') &&
         found->number >= least && found->number <= most;
}

bool is_finite(std::string_view text) {
  const auto found = quantity<double>(text.substr(text.starts_with('-') ? 1 : 0));
  return found && found->unit.empty();
}

/// Seconds.
std::optional<double> time_unit(std::string_view unit) {
  if (unit.empty() || unit == "s") {
    return 1;
  }
  return unit == "min" ? std::optional(60.0) : unit == "h" ? std::optional(3600.0) : std::nullopt;
}

/// Bytes of `k`, `KB`, `KiB` and so on, all of 1024.
std::optional<double> size_unit(std::string_view text) {
  const std::string unit = CLI::ignore_case(std::string(text));
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

/// Takes what `converted` turns into another text. `shown`: in the help, after the type.
CLI::Validator conversion(
    const std::string& what, const std::string& shown,
    const std::function<std::optional<std::string>(const std::string&)>& converted) {
  const auto convert = [=](std::string& text) -> std::string {
    const auto result = converted(text);
    if (!result) {
      return fmt::format("expected {}, found {}", what, text::shown(text));
    }
    text = *result;
    return {};
  };
  return {convert, shown};
}

CLI::Validator check(const std::string& what, const std::string& shown,
                     const std::function<bool(const std::string&)>& is_right) {
  return conversion(what, shown, [=](const std::string& text) {
    return is_right(text) ? std::optional(text) : std::nullopt;
  });
}

/// Takes a number with a unit and makes a plain number of it, by the factor of the unit; from
/// `least` to `most`.
template <class T>
CLI::Validator with_unit(const std::string& what,
                         std::optional<double> (*value_of)(std::string_view unit), double least,
                         double most) {
  return conversion(what, "", [=](const std::string& text) -> std::optional<std::string> {
    const auto found = quantity<T>(text);
    const auto unit = found ? value_of(found->unit) : std::nullopt;
    const double value = unit ? static_cast<double>(found->number) * *unit : NAN;
    return value >= least && value <= most ? std::optional(fmt::format("{}", static_cast<T>(value)))
                                           : std::nullopt;
  });
}

}  // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const bool is_any = least == 0 && most == std::numeric_limits<std::uint64_t>::max();
  return check(fmt::format("a whole number from {} to {}", least, most),
               is_any ? "" : fmt::format("in [{} - {}]", least, most),
               [=](const std::string& text) { return is_whole(text, least, most); });
}

CLI::Validator length_of_figure() {
  return check("a whole number of pixels from 100 to 10000, or 20mm to 1000mm",
               "in [100 - 10000] or [20mm - 1000mm]", [](const std::string& text) {
                 const bool is_mm = text.ends_with("mm");
                 return is_mm ? is_whole(text.substr(0, text.size() - 2), 20, 1000)
                              : is_whole(text, 100, 10'000);
               });
}

CLI::Validator finite_number() {
  return check("a number", "", is_finite);
}

CLI::Validator limits_of_axis() {
  return check("two numbers, as 0:5 or :5", "", [](const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto is_limit = [](const std::string& part) { return part.empty() || is_finite(part); };
    return colon < text.size() && text.size() > 1 && is_limit(text.substr(0, colon)) &&
           is_limit(text.substr(colon + 1));
  });
}

CLI::Validator part_of_whole(std::uint64_t most) {
  return check(fmt::format("K/N with K from 1 to N and N up to {}", most), "",
               [most](const std::string& text) {
                 const std::size_t slash = text.find('/');
                 const auto of = slash < text.size() ? text.substr(slash + 1) : "";
                 return is_whole(of, 1, most) &&
                        is_whole(text.substr(0, slash), 1, quantity<std::uint64_t>(of)->number);
               });
}

CLI::Validator value_of_key(const std::string& key) {
  const std::vector<std::string> words = scene::words_of(key);
  return CLI::Validator(words.empty() ? "" : fmt::format("{{{}}}", fmt::join(words, ",")));
}

CLI::Validator assignment(const std::string& form) {
  return check(form + ", as in rules.inertia=0.5", "",
               [](const std::string& text) { return text.find('=') != std::string::npos; });
}

CLI::Validator time_span() {
  return with_unit<double>("a time up to 1e9 seconds, as in 90, 30min or 2h", time_unit, 0, 1e9);
}

CLI::Validator byte_size() {
  return with_unit<std::uint64_t>("a size from 1 to 4EiB, as in 512MiB or 4GiB", size_unit, 1,
                                  0x1p62);
}

}  // namespace clca::cli
