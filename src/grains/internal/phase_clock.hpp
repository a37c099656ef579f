#pragma once
// Measures how long the phases of a step take.

#include <algorithm>
#include <chrono>

#include "clca/grains/model.hpp"

namespace clca::grains {

class PhaseClock {
 public:
  /// Measures nothing if `times` is null.
  explicit PhaseClock(PhaseTimes* times) : times_(times) {
    if (times_ != nullptr) {
      since_ = Clock::now();
    }
  }

  /// Adds the time since the end of the last phase to `phase`, a literal.
  void end(std::string_view phase) {
    if (times_ == nullptr) {
      return;
    }
    const Clock::time_point now = Clock::now();
    auto found = std::ranges::find(*times_, phase, &PhaseTimes::value_type::first);
    if (found == times_->end()) {
      found = times_->insert(found, {phase, 0});
    }
    found->second += std::chrono::duration<double>(now - since_).count();
    since_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;

  PhaseTimes* times_;
  Clock::time_point since_{};
};

}  // namespace clca::grains
