#include "report/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clca/text/message.hpp"
#include "clca/text/utf8.hpp"

namespace clca::report {

namespace {

constexpr std::string_view kNarrowSpace = "\u202f";
constexpr std::string_view kMinus = "\u2212";
constexpr double kTooLarge = 1e7;
constexpr double kTooSmall = 1e-3;

std::string_view entity(char letter) {
  switch (letter) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

/// Groups of three before the point.
std::string grouped(std::string_view digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  std::string result;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && i < point && (point - i) % 3 == 0 && point > 4) {
      result += kNarrowSpace;
    }
    result += digits[i];
  }
  return result;
}

std::string scientific(double number) {
  int exponent = static_cast<int>(std::floor(std::log10(std::abs(number))));
  double mantissa = number / std::pow(10.0, exponent);
  if (std::abs(mantissa) >= 9.995) {  // shown as 10.00
    mantissa /= 10;
    ++exponent;
  }
  return fmt::format("{}{:.2f} × {}", number < 0 ? kMinus : "", std::abs(mantissa),
                     power_of_ten(exponent));
}

/// Too large, or too small to show three digits.
bool is_scientific(double number, int decimals) {
  const double size = std::abs(number);
  return size >= kTooLarge || (size < kTooSmall && size > 0 && size * std::pow(10, decimals) < 100);
}

}  // namespace

std::string escaped(std::string_view text) {
  constexpr std::string_view kUnknown = "\ufffd";
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = text::character_length(text, i);
    const std::string_view sign = text.substr(i, std::max<std::size_t>(length, 1));
    const bool is_layout = sign == "\n" || sign == "\t";
    if (length == 0 || (!is_layout && text::is_control(text::character_at(text, i)))) {
      result += kUnknown;
    } else {
      const std::string_view replaced = entity(sign.front());
      result += replaced.empty() ? sign : replaced;
    }
    i += sign.size();
  }
  return result;
}

std::string whole(std::uint64_t number) {
  return grouped(fmt::format("{}", number));
}

std::string brief(double number) {
  return with_decimals(number, decimals_for({&number, 1}));
}

int decimals_for(std::span<const double> numbers) {
  double largest = 0;
  bool all_whole = true;
  for (const double number : numbers) {
    if (std::isfinite(number)) {
      largest = std::max(largest, std::abs(number));
      all_whole = all_whole && number == std::round(number);
    }
  }
  if (all_whole || largest == 0) {
    return 0;
  }
  return std::clamp(3 - static_cast<int>(std::floor(std::log10(largest))), 0, 6);
}

int decimals_for(std::span<const double> numbers, std::span<const double> errors) {
  constexpr int kMaxDecimals = 7;
  double smallest = 0;
  for (const double error : errors) {
    if (error > 0 && std::isfinite(error)) {
      smallest = smallest > 0 ? std::min(smallest, error) : error;
    }
  }
  return smallest > 0
             ? std::clamp(1 - static_cast<int>(std::floor(std::log10(smallest))), 0, kMaxDecimals)
             : decimals_for(numbers);
}

std::string number_html(double number, double error, int decimals) {
  std::string text = number == 0 ? "0" : with_decimals(number, decimals);
  if (!std::isfinite(error)) {
    return text;
  }
  const bool is_small = error > 0 && is_scientific(number, decimals);
  return text + fmt::format("<small> ± {}</small>",
                            is_small ? scientific(error) : fmt::format("{:.{}f}", error, decimals));
}

std::string with_decimals(double number, int decimals) {
  if (!std::isfinite(number)) {
    return std::isnan(number) ? "–" : number > 0 ? "∞" : "−∞";
  }
  if (is_scientific(number, decimals)) {
    return scientific(number);
  }
  return (number < 0 ? std::string(kMinus) : "") +
         grouped(fmt::format("{:.{}f}", std::abs(number), decimals));
}

std::string power_of_ten(int exponent) {
  constexpr std::array<std::string_view, 10> kRaised = {"⁰", "¹", "²", "³", "⁴",
                                                        "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string result = exponent < 0 ? "10⁻" : "10";
  for (const char digit : fmt::format("{}", std::abs(exponent))) {
    result += kRaised[static_cast<std::size_t>(digit - '0')];
  }
  return result;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(bytes.size() - i, 3);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = (three << 8U) | (k < count ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= count ? kLetters[(three >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return result;
}

}  // namespace clca::report
