#pragma once
// Logarithm, sine and cosine from basic IEEE operations only: libraries differ in the last bit.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace clca::boltzmann {

/// 52 uniform bits as a number in (0, 1): never 0, never 1.
inline double open_uniform(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

/// 32 uniform bits as a number in (0, 1).
inline double open_uniform32(std::uint32_t bits) {
  return (bits + 0.5) * 0x1p-32;
}

/// Natural logarithm of a normal positive number, to 3e-16 relative or 3e-16 absolute.
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
  const double square = z * z;
  double sum = 0;
  for (int order = 23; order >= 1; order -= 2) {
    sum = sum * square + 1.0 / order;
  }
  return static_cast<double>(exponent) * std::numbers::ln2 + 2 * z * sum;
}

/// 1 / n! for every other n from `kBegin` down to 0 or 1, rounded once.
template <int kBegin>
constexpr auto inverse_factorials() {
  std::array<double, kBegin / 2 + 1> result{};
  result.fill(1);        // of 0
  double factorial = 1;  // exact up to 18!
  for (int n = 1; n <= kBegin; ++n) {
    factorial *= n;
    if ((kBegin - n) % 2 == 0) {
      result[static_cast<std::size_t>((kBegin - n) / 2)] = 1 / factorial;
    }
  }
  return result;
}

/// c_n - square (c_(n-1) - square (... - square c_0)).
template <class Real, std::size_t kCount>
Real alternating_sum(const Real& square, const std::array<double, kCount>& coefficients) {
  Real sum = square * 0 + coefficients[0];
  for (std::size_t i = 1; i < kCount; ++i) {
    sum = coefficients[i] - square * sum;
  }
  return sum;
}

/// Cosine and sine of 2 pi `turns` for `turns` in [0, 1), to 2e-16. Real is double or an Eigen
/// array: the same bits. Other modules have sines of other exactness, see CONTRIBUTING.md.
template <class Real>
std::pair<Real, Real> cosine_and_sine(const Real& turns) {
  using std::abs;
  constexpr auto kCosine = inverse_factorials<16>();
  constexpr auto kSine = inverse_factorials<17>();
  constexpr double kToInteger = 0x1.8p52;  // what is added to this is rounded
  const Real centred = turns - 0.5;
  const Real quarters = (4.0 * centred + kToInteger) - kToInteger;          // -2 to 2
  const Real angle = (centred - 0.25 * quarters) * (2 * std::numbers::pi);  // up to pi / 4
  const Real square = angle * angle;
  const Real cosine = alternating_sum(square, kCosine);
  const Real sine = alternating_sum(square, kSine) * angle;
  // Turned by the quarters and by a half: cosine and sine of these are exact.
  const Real quarter_cosine = abs(quarters) - 1.0;
  const Real quarter_sine = quarters * (abs(quarters) - 2.0);
  return {quarter_cosine * cosine - quarter_sine * sine,
          quarter_sine * cosine + quarter_cosine * sine};
}

}  // namespace clca::boltzmann
