#pragma once
// Measures how long the phases of a step take.

#include <chrono>

namespace clca::grains {

/// `Profile` has a member of type double, in seconds, for each phase.
template <class Profile>
class PhaseClock {
 public:
  /// Measures nothing if `profile` is null.
  explicit PhaseClock(Profile* profile) : profile_(profile) {
    if (profile_ != nullptr) {
      since_ = Clock::now();
    }
  }

  /// Adds the time since the end of the last phase to `phase`.
  void end(double Profile::*phase) {
    if (profile_ != nullptr) {
      const Clock::time_point now = Clock::now();
      profile_->*phase += std::chrono::duration<double>(now - since_).count();
      since_ = now;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  Profile* profile_;
  Clock::time_point since_{};
};

}  // namespace clca::grains
