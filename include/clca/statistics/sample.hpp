#pragma once
// Mean and spread of a sample; ranges of numbers.

#include <cstddef>
#include <utility>
#include <vector>

namespace clca::statistics {

struct Range {
  double low = 0;
  double high = 1;

  bool operator==(const Range&) const = default;
};

/// NaN if there are too few values: any statistic of none, a spread of one; also if they are so
/// large that their sum, or that of their squares, is no finite number.
struct Sample {
  double mean = 0;
  double standard_deviation = 0;  ///< of the sample, over n - 1
  double standard_error = 0;      ///< of the mean
  std::size_t count = 0;          ///< of the values
  double least = 0;
  double most = 0;
};

/// Over the finite values, in order.
Sample sample(const std::vector<double>& values);

/// Lower and upper end of the interval of one standard error for a share found among `count`
/// answers of yes and no. By E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927): within 0 and 1, and
/// not empty where all answers are the same. NaN for none.
std::pair<double, double> share_interval(double share, std::size_t count);

}  // namespace clca::statistics
