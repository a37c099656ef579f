#pragma once
// How fast a run goes and how long it may still take. Nothing here touches the result.

#include <chrono>
#include <cstdint>
#include <optional>

namespace clca::run {

/// Seconds since it was made.
class WallClock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Adds up the time between start() and stop().
class Stopwatch {
 public:
  void start() { since_ = Clock::now(); }
  void stop() { total_ += Clock::now() - since_; }
  double seconds() const { return std::chrono::duration<double>(total_).count(); }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point since_{};
  Clock::duration total_{};
};

/// True at most once per `interval`, so that a report costs nothing.
class Ticker {
 public:
  explicit Ticker(std::chrono::milliseconds interval) : interval_(interval) {}

  bool due() {
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

/// Guesses the time to the end of a stage from how far it has come.
class Forecast {
 public:
  /// Takes the part of the stage that is done, in [0, 1].
  void update(double done) { done_ = done; }
  /// None in the first moments of a stage.
  std::optional<double> seconds_left() const {
    constexpr double kLeastDone = 1e-3;
    if (done_ < kLeastDone) {
      return std::nullopt;
    }
    return clock_.seconds() * (1 - done_) / done_;
  }

 private:
  WallClock clock_;
  double done_ = 0;
};

}  // namespace clca::run
