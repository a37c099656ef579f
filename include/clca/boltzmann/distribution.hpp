#pragma once
// Distributions of energies, and how far they are from chi-square.

#include <cstdint>
#include <span>
#include <vector>

namespace clca::boltzmann {

/// F(x) of the chi-square distribution with 2 or 3 degrees of freedom; 0 for x <= 0. Throws
/// std::invalid_argument for other numbers of degrees.
double chi_square_cdf(double x, int degrees);
/// Inverse of it; throws std::invalid_argument for a probability outside [0, 1).
double chi_square_quantile(double probability, int degrees);

/// Bins of a variable that is not negative: edges ascend from 0, the last bin has no end.
class Bins {
 public:
  /// `count` bins of equal probability under chi-square. Throws std::invalid_argument unless there
  /// are 2 to 1000.
  static Bins equiprobable(int count, int degrees);
  /// Bins of one width from 0 to `end`, the last of them cut short there, and one beyond. Throws
  /// std::invalid_argument unless both are positive and `end` is 1 to 1e6 widths.
  static Bins uniform(double width, double end);

  std::size_t count() const { return edges_.size(); }
  // Precondition of both: bin < count().
  double lower(std::size_t bin) const { return edges_[bin]; }
  /// Infinity for the last.
  double upper(std::size_t bin) const;
  /// Bin with lower <= x < upper.
  std::size_t find(double x) const;

 private:
  explicit Bins(std::vector<double> edges) : edges_(std::move(edges)) {}
  std::vector<double> edges_;  // lower ones
};

/// Probability of each bin under chi-square, integrated exactly.
std::vector<double> chi_square_shares(const Bins& bins, int degrees);

/// Share of the values in each bin; zeros where there are no values.
std::vector<double> shares(std::span<const double> values, const Bins& bins);

/// D_H = 1 - sum sqrt(p q), from 0 (equal) to 1. Throws std::invalid_argument unless both have the
/// same length.
double hellinger_distance(std::span<const double> p, std::span<const double> q);

/// What the distance of a sample of that size is on the average where there is none:
/// (bins - 2) / (8 samples), the scale having been taken from the sample. Throws
/// std::invalid_argument for fewer than 2 bins or no samples.
double hellinger_floor(std::size_t bins, std::size_t samples);

}  // namespace clca::boltzmann
