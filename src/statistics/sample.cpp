#include "clca/statistics/sample.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace clca::statistics {

namespace {

constexpr int kMaxEquiprobableBins = 1000;
constexpr double kMaxUniformBins = 1e6;

/// Solves cdf(x) = probability between two numbers, to the last bit.
double bisect(double low, double high, double probability, int degrees) {
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) {
      return high;
    }
    (chi_square_cdf(middle, degrees) < probability ? low : high) = middle;
  }
}

}  // namespace

SampleStatistics sample_statistics(const std::vector<double>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  SampleStatistics result = {kNone, kNone, kNone, finite.size(), kNone, kNone};
  if (finite.empty()) {
    return result;
  }
  const auto count = static_cast<double>(finite.size());
  const auto [least, most] = std::minmax_element(finite.begin(), finite.end());
  result.least = *least;
  result.most = *most;
  // Counted from the first value: exact where all values are the same.
  const double origin = finite.front();
  double sum = 0;
  for (const double value : finite) {
    sum += value - origin;
  }
  result.mean = std::isfinite(sum) ? origin + sum / count : kNone;
  double squares = 0;
  for (const double value : finite) {
    squares += (value - result.mean) * (value - result.mean);
  }
  if (finite.size() > 1 && std::isfinite(squares)) {
    result.standard_deviation = std::sqrt(squares / (count - 1));
    result.standard_error = result.standard_deviation / std::sqrt(count);
  }
  return result;
}

std::pair<double, double> wilson_interval(double share, std::size_t count) {
  const auto n = static_cast<double>(count);
  const double middle = (share + 1 / (2 * n)) / (1 + 1 / n);
  const double half = std::sqrt(share * (1 - share) / n + 1 / (4 * n * n)) / (1 + 1 / n);
  return {std::clamp(middle - half, 0.0, share), std::clamp(middle + half, share, 1.0)};
}

double chi_square_cdf(double x, int degrees) {
  if (degrees != 2 && degrees != 3) {
    throw std::invalid_argument(std::to_string(degrees) + " degrees of freedom, not 2 or 3");
  }
  if (x <= 0) {
    return 0;
  }
  if (std::isinf(x)) {
    return 1;
  }
  if (degrees == 2) {
    return -std::expm1(-x / 2);
  }
  return std::erf(std::sqrt(x / 2)) - std::sqrt(2 * x * std::numbers::inv_pi) * std::exp(-x / 2);
}

double chi_square_quantile(double probability, int degrees) {
  if (!(probability >= 0 && probability < 1)) {
    throw std::invalid_argument("probability " + std::to_string(probability) + " is not in [0, 1)");
  }
  double high = 1;
  while (chi_square_cdf(high, degrees) < probability) {
    high *= 2;
  }
  return probability == 0 ? 0 : bisect(0, high, probability, degrees);
}

Bins Bins::equiprobable(int count, int degrees) {
  if (count < 2 || count > kMaxEquiprobableBins) {
    throw std::invalid_argument(std::to_string(count) + " bins, not 2 to " +
                                std::to_string(kMaxEquiprobableBins));
  }
  std::vector<double> edges;
  for (int bin = 0; bin < count; ++bin) {
    edges.push_back(chi_square_quantile(static_cast<double>(bin) / count, degrees));
  }
  return Bins(std::move(edges));
}

Bins Bins::uniform(double width, double end) {
  if (!(width > 0 && width <= end && end / width <= kMaxUniformBins)) {
    throw std::invalid_argument("bins of width " + std::to_string(width) + " up to " +
                                std::to_string(end));
  }
  constexpr double kRounding = 1e-9;  // 0.3 is three bins of 0.1
  std::vector<double> edges;
  for (int bin = 0; bin < end / width - kRounding; ++bin) {
    edges.push_back(bin * width);
  }
  edges.push_back(end);
  return Bins(std::move(edges));
}

double Bins::upper(std::size_t bin) const {
  return bin + 1 < count() ? edges_[bin + 1] : std::numeric_limits<double>::infinity();
}

std::size_t Bins::bin_of(double x) const {
  // std::upper_bound without branches, half of which would be mispredicted.
  const double* edge = edges_.data();
  for (std::size_t left = count(); left > 1;) {
    const std::size_t half = left / 2;
    edge += edge[half] <= x ? half : 0;
    left -= half;
  }
  return static_cast<std::size_t>(edge - edges_.data());
}

std::vector<double> chi_square_shares(const Bins& bins, int degrees) {
  std::vector<double> result;
  for (std::size_t bin = 0; bin < bins.count(); ++bin) {
    result.push_back(chi_square_cdf(bins.upper(bin), degrees) -
                     chi_square_cdf(bins.lower(bin), degrees));
  }
  return result;
}

std::vector<double> bin_shares(std::span<const double> values, const Bins& bins) {
  std::vector<std::uint64_t> counts(bins.count());
  for (const double value : values) {
    ++counts[bins.bin_of(value)];
  }
  std::vector<double> result(bins.count());
  const auto all = static_cast<double>(std::max<std::size_t>(values.size(), 1));
  std::transform(counts.begin(), counts.end(), result.begin(),
                 [&](std::uint64_t count) { return static_cast<double>(count) / all; });
  return result;
}

double hellinger_distance(std::span<const double> p, std::span<const double> q) {
  if (p.size() != q.size()) {
    throw std::invalid_argument("distributions over " + std::to_string(p.size()) + " and " +
                                std::to_string(q.size()) + " bins cannot be compared");
  }
  double overlap = 0;
  for (std::size_t bin = 0; bin < p.size(); ++bin) {
    overlap += std::sqrt(p[bin] * q[bin]);
  }
  return std::max(0.0, 1 - overlap);
}

double expected_hellinger_distance(std::size_t bins, std::size_t samples) {
  if (bins < 2 || samples == 0) {
    throw std::invalid_argument("there is no distance without 2 bins and a sample");
  }
  return (static_cast<double>(bins) - 2) / (8 * static_cast<double>(samples));
}

}  // namespace clca::statistics
