#pragma once
// Logarithm, sine and cosine from basic operations of IEEE arithmetic only: those of the system
// differ in the last bit from machine to machine, and a run may not.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace clca::boltzmann {

/// 53 uniform bits as a number in (0, 1): never 0, never 1.
inline double open_unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

/// c0 + c1 x + c2 x^2 + ... by Horner's rule. Real is double or an Eigen array.
template <class Real, std::size_t kTerms>
Real polynomial(const std::array<double, kTerms>& coefficients, const Real& x) {
  Real sum = x * coefficients[kTerms - 1] + coefficients[kTerms - 2];
  for (std::size_t i = kTerms - 2; i > 0; --i) {
    sum = sum * x + coefficients[i - 1];
  }
  return sum;
}

/// 1, 1/3, 1/5, ...: of atanh.
inline constexpr std::array kAtanhTerms = [] {
  std::array<double, 12> terms{};
  for (std::size_t i = 0; i < terms.size(); ++i) {
    terms[i] = 1.0 / static_cast<double>(2 * i + 1);
  }
  return terms;
}();

/// (-1)^i / (2 i + first)!: of the cosine for 0, of the sine for 1.
constexpr std::array<double, 9> circle_terms(int first) {
  std::array<double, 9> terms{};
  double term = 1;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    terms[i] = term;
    const double next = static_cast<double>(2 * i) + first + 1;
    term /= -next * (next + 1);
  }
  return terms;
}
inline constexpr std::array kCosineTerms = circle_terms(0);
inline constexpr std::array kSineTerms = circle_terms(1);

/// Natural logarithm of a normal positive number, to 2e-16 relative or 2e-16 absolute.
inline double logarithm(double x) {
  constexpr int kMantissaBits = 52;
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << kMantissaBits) - 1;
  constexpr int kBias = 1023;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> kMantissaBits) - kBias;
  auto mantissa = std::bit_cast<double>((bits & kMantissa) |
                                        (std::uint64_t{kBias} << kMantissaBits));  // in [1, 2)
  if (mantissa > std::numbers::sqrt2) {
    mantissa *= 0.5;
    ++exponent;
  }
  // log m = 2 atanh z, z = (m - 1) / (m + 1), |z| < 0.1716.
  const double z = (mantissa - 1) / (mantissa + 1);
  return static_cast<double>(exponent) * std::numbers::ln2 + 2 * z * polynomial(kAtanhTerms, z * z);
}

/// Cosine and sine of 2 pi `turns`, for `turns` in [0, 1). Real is double or an Eigen array.
template <class Real>
std::pair<Real, Real> cosine_and_sine(const Real& turns) {
  // The angle is 4 h + pi, |h| <= pi/4.
  const Real h = (turns - 0.5) * (std::numbers::pi / 2);
  const Real square = h * h;
  const Real sine = h * polynomial(kSineTerms, square);
  const Real cosine = polynomial(kCosineTerms, square);
  const Real sine2 = 2.0 * sine * cosine;
  const Real cosine2 = 1.0 - 2.0 * sine * sine;
  return {2.0 * sine2 * sine2 - 1.0, -2.0 * sine2 * cosine2};
}

}  // namespace clca::boltzmann
