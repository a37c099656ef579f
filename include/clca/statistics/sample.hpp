#pragma once
// Samples: mean and spread, shares in bins and their distance from chi-square; ranges of numbers.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace clca::statistics {

struct Range {
  double low = 0;
  double high = 1;

  bool operator==(const Range&) const = default;
};

/// Statistics of some values. NaN if there are too few: any statistic of none, a spread of one;
/// also if they are so large that their sum, or that of their squares, is no finite number.
struct SampleStatistics {
  double mean = 0;
  double standard_deviation = 0;  ///< of the sample, over n - 1
  double standard_error = 0;      ///< of the mean
  std::size_t count = 0;          ///< of the values
  double least = 0;
  double most = 0;
};

/// Statistics of the finite values, in order.
SampleStatistics sample_statistics(const std::vector<double>& values);

/// Lower and upper end of the interval of one standard error for a share found among `count`
/// answers of yes and no. By E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927): within 0 and 1, and
/// not empty where all answers are the same. NaN for none.
std::pair<double, double> wilson_interval(double share, std::size_t count);

/// Cumulative chi-square distribution with 2 or 3 degrees of freedom; 0 for x <= 0.
/// Throws std::invalid_argument for other `degrees`.
double chi_square_cdf(double x, int degrees);
/// Its inverse. Throws std::invalid_argument unless probability is in [0, 1).
double chi_square_quantile(double probability, int degrees);

/// Bins of a non-negative variable: edges ascend from 0, the last bin is unbounded.
class Bins {
 public:
  /// `count` bins of equal probability under chi-square. Throws std::invalid_argument unless
  /// `count` is 2 to 1000.
  static Bins equiprobable(int count, int degrees);
  /// Bins of equal width from 0 to `end`, where the last is cut off, and one bin beyond.
  /// Throws std::invalid_argument unless both are positive and `end` is 1 to 1e6 widths.
  static Bins uniform(double width, double end);

  std::size_t count() const { return edges_.size(); }
  // Precondition of both: bin < count().
  double lower(std::size_t bin) const { return edges_[bin]; }
  /// Infinity for the last bin.
  double upper(std::size_t bin) const;
  /// The bin with lower <= x < upper.
  std::size_t bin_of(double x) const;

 private:
  explicit Bins(std::vector<double> edges) : edges_(std::move(edges)) {}
  std::vector<double> edges_;  // lower ones
};

/// Exact probability of each bin under chi-square.
std::vector<double> chi_square_shares(const Bins& bins, int degrees);

/// Share of the values in each bin; zeros if there are no values.
std::vector<double> bin_shares(std::span<const double> values, const Bins& bins);

/// D_H = 1 - sum sqrt(p q): 0 if equal, at most 1. Throws std::invalid_argument for unlike lengths.
double hellinger_distance(std::span<const double> p, std::span<const double> q);

/// Expected distance of a sample from its own distribution: (bins - 2) / (8 samples), with the
/// scale taken from the sample. Throws std::invalid_argument for fewer than 2 bins or no samples.
double expected_hellinger_distance(std::size_t bins, std::size_t samples);

}  // namespace clca::statistics
