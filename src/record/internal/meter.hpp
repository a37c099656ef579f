#pragma once
// Speed and remaining time of a run. Does not affect results.

#include <algorithm>
#include <chrono>
#include <optional>

namespace clca::record {

/// Seconds since construction.
class WallClock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Timer that is due at most once per `interval`.
class IntervalTimer {
 public:
  explicit IntervalTimer(std::chrono::milliseconds interval) : interval_(interval) {}

  bool is_due() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) {
      return false;
    }
    next_ = now + interval_;
    return true;
  }

 private:
  std::chrono::milliseconds interval_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + interval_;
};

/// Estimates the remaining time of a stage from its progress.
class TimeEstimate {
 public:
  /// `done`: share of the stage, in [0, 1]; first the share done before. It may stay the same.
  void update(double done) {
    if (!clock_) {
      clock_.emplace();
      before_ = done_ = done;
    } else if (done > done_) {
      done_ = done;
      seconds_ = clock_->seconds();
    }
  }
  /// None before the first progress, and where more time has passed than expected.
  std::optional<double> seconds_left() const {
    constexpr double kMinDone = 1e-3;
    if (done_ - before_ < kMinDone) {
      return std::nullopt;
    }
    const double left = seconds_ * (1 - before_) / (done_ - before_) - clock_->seconds();
    return left > 0 || done_ >= 1 ? std::optional(std::max(left, 0.0)) : std::nullopt;
  }

 private:
  std::optional<WallClock> clock_;  ///< since the first update
  double before_ = 0;
  double done_ = 0;
  double seconds_ = 0;  ///< at the last progress
};

}  // namespace clca::record
