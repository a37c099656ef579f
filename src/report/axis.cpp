#include "report/axis.hpp"

#include <algorithm>
#include <cmath>

#include "report/text.hpp"

namespace clca::report {

namespace {

constexpr double kMostTicks = 6;

/// 1, 2 or 5 times a power of ten, not less than `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - 1e-9)) {
      return factor * power;
    }
  }
  return 10 * power;
}

/// Two ends that are apart, also in floating point.
std::pair<double, double> apart(double low, double high) {
  const double least = 1e-9 * std::max(std::abs(low), std::abs(high));
  if (high - low > least) {
    return {low, high};
  }
  const double half = low == 0 ? 0.5 : std::abs(low) / 10;
  return {low - half, low + half};
}

/// So that labels stay short.
int left_out(double largest) {
  constexpr double kTooLong = 1e6;
  constexpr double kTooShort = 1e-2;
  return largest < kTooLong && largest >= kTooShort
             ? 0
             : static_cast<int>(std::floor(std::log10(largest)));
}

}  // namespace

Axis Axis::linear(double low, double high, bool is_round) {
  Axis axis;
  // Beyond this the differences below overflow.
  constexpr double kLargest = 1e300;
  const auto [begin, end] =
      apart(std::clamp(low, -kLargest, kLargest), std::clamp(high, -kLargest, kLargest));
  const double step = round_step((end - begin) / kMostTicks);
  const double first = is_round ? std::floor(begin / step + 1e-9) : std::ceil(begin / step - 1e-9);
  const double last = is_round ? std::ceil(end / step - 1e-9) : std::floor(end / step + 1e-9);
  axis.low_ = is_round ? first * step : begin;
  axis.high_ = is_round ? last * step : end;
  const int count = static_cast<int>(std::min(last - first, 2 * kMostTicks));
  for (int i = 0; i <= count; ++i) {
    axis.ticks_.push_back((first + i) * step);
  }
  axis.exponent_ = left_out(std::max(std::abs(axis.low_), std::abs(axis.high_)));
  const int finest = static_cast<int>(std::floor(std::log10(step) + 1e-9)) - axis.exponent_;
  axis.decimals_ = std::clamp(-finest, 0, 6);
  return axis;
}

Axis Axis::logarithmic(double low, double high) {
  Axis axis;
  axis.is_logarithmic_ = true;
  constexpr double kMost = 300;  // decades that floating point can hold
  const double begin = std::clamp(std::log10(low), -kMost, kMost - 1);
  const double end = std::clamp(std::log10(high), begin, kMost);
  const int first = static_cast<int>(std::floor(begin + 1e-9));
  const int last = std::max(static_cast<int>(std::ceil(end - 1e-9)), first + 1);
  axis.low_ = std::pow(10.0, first);
  axis.high_ = std::pow(10.0, last);
  const int every = (last - first + static_cast<int>(kMostTicks)) / static_cast<int>(kMostTicks);
  for (int exponent = first; exponent <= last; exponent += every) {
    axis.ticks_.push_back(std::pow(10.0, exponent));
  }
  return axis;
}

std::string Axis::label(double tick) const {
  constexpr int kWritten = 2;  // 0.01 to 100 are written out
  if (is_logarithmic_) {
    const int exponent = static_cast<int>(std::round(std::log10(tick)));
    return std::abs(exponent) <= kWritten ? with_decimals(tick, std::max(-exponent, 0))
                                          : power_of_ten(exponent);
  }
  const bool is_zero = std::abs(tick) < 1e-9 * (high_ - low_);
  return with_decimals(is_zero ? 0 : tick / std::pow(10.0, exponent_), decimals_);
}

double Axis::part(double value) const {
  return is_logarithmic_ ? std::log(value / low_) / std::log(high_ / low_)
                         : (value - low_) / (high_ - low_);
}

}  // namespace clca::report
