#pragma once
// Logarithm, sine and cosine from basic operations of IEEE arithmetic only: those of the system
// differ in the last bit from machine to machine, and a run may not.

#include <bit>
#include <cstdint>
#include <numbers>
#include <utility>

namespace clca::boltzmann {

/// 53 uniform bits as a number in (0, 1): never 0, never 1.
inline double open_unit(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52;
}

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
  const double square = z * z;
  double sum = 0;
  for (int order = 23; order >= 1; order -= 2) {
    sum = sum * square + 1.0 / order;
  }
  return static_cast<double>(exponent) * std::numbers::ln2 + 2 * z * sum;
}

/// Cosine and sine of 2 pi `turns`, for `turns` in [0, 1). Real is double or an Eigen array.
template <class Real>
std::pair<Real, Real> cosine_and_sine(const Real& turns) {
  // With h = pi (turns - 1/2) / 2, |h| <= pi/4: the angle is 4 h + pi.
  const Real h = (turns - 0.5) * (std::numbers::pi / 2);
  const Real square = h * h;
  Real sine = square * 0 + 1.0;
  for (int order = 16; order >= 2; order -= 2) {
    sine = 1.0 - square * sine / (order * (order + 1.0));
  }
  Real cosine = square * 0 + 1.0;
  for (int order = 15; order >= 1; order -= 2) {
    cosine = 1.0 - square * cosine / (order * (order + 1.0));
  }
  sine = sine * h;
  const Real sine2 = 2.0 * sine * cosine;
  const Real cosine2 = 1.0 - 2.0 * sine * sine;
  // Twice the doubled angle, plus half a turn.
  return {2.0 * sine2 * sine2 - 1.0, -2.0 * sine2 * cosine2};
}

}  // namespace clca::boltzmann
