#include "clca/statistics/sample.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace clca::statistics {

Sample sample(const std::vector<double>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  Sample result = {kNone, kNone, kNone, finite.size(), kNone, kNone};
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

std::pair<double, double> share_interval(double share, std::size_t count) {
  const auto n = static_cast<double>(count);
  const double middle = (share + 1 / (2 * n)) / (1 + 1 / n);
  const double half = std::sqrt(share * (1 - share) / n + 1 / (4 * n * n)) / (1 + 1 / n);
  return {std::clamp(middle - half, 0.0, share), std::clamp(middle + half, share, 1.0)};
}

}  // namespace clca::statistics
