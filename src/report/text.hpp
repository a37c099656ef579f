#pragma once
// Formatting of text and numbers for the page.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace clca::report {

/// `text` for use between tags and in quoted attributes: nothing in it is markup. Bytes that are
/// not UTF-8 and control characters are written as the sign for what cannot be shown.
std::string escaped(std::string_view text);

/// 12 345: groups of three by narrow spaces.
std::string whole(std::uint64_t number);

/// Four significant digits: 0.1235, 12 350, 1.2 × 10⁻⁵; a dash where there is no number.
std::string brief(double number);

/// Digits after the point with which numbers stand below each other: four significant ones in the
/// largest, none where all are whole.
int decimals_for(std::span<const double> numbers);

/// The same with two significant digits of the smallest of `errors` above 0, if there is one.
int decimals_for(std::span<const double> numbers, std::span<const double> errors);

/// With so many digits after the point; as 1.20 × 10⁻⁵ where it is too large or too small for that.
std::string with_decimals(double number, int decimals);

/// A number with its standard error (NaN: none) as HTML.
std::string number_html(double number, double error, int decimals);

/// 10⁻³.
std::string power_of_ten(int exponent);

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace clca::report
