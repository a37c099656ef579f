#pragma once
// The axis of a chart: its range in round numbers, and its ticks.

#include <string>
#include <vector>

namespace clca::report {

class Axis {
 public:
  /// From `low` to `high`, both finite. With `is_round` the ends move outwards to ticks.
  static Axis linear(double low, double high, bool is_round);
  /// Decades; both ends above 0.
  static Axis logarithmic(double low, double high);

  double low() const { return low_; }
  double high() const { return high_; }
  bool is_logarithmic() const { return is_logarithmic_; }
  const std::vector<double>& ticks() const { return ticks_; }
  /// What the labels leave out: a tick is its label times ten to this.
  int exponent() const { return exponent_; }
  std::string label(double tick) const;
  /// 0 at the low end, 1 at the high one.
  double part(double value) const;

 private:
  double low_ = 0;
  double high_ = 1;
  bool is_logarithmic_ = false;
  int exponent_ = 0;
  int decimals_ = 0;
  std::vector<double> ticks_;
};

}  // namespace clca::report
