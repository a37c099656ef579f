#pragma once
// Mean and spread of a measure over runs.

#include <cstddef>
#include <vector>

namespace clca::sweep {

/// NaN stands for what so few values do not have: any of them for none, a spread for one.
struct Statistics {
  double mean = 0;
  double standard_deviation = 0;  ///< of the sample, over n - 1
  double standard_error = 0;      ///< of the mean
  std::size_t count = 0;          ///< of the values
  double least = 0;
  double most = 0;
};

/// Over the values that are finite, in their order.
Statistics statistics(const std::vector<double>& values);

}  // namespace clca::sweep
