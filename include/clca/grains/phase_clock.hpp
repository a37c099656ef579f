#pragma once
// Measures the phases of a step, where somebody wants to know.

#include <chrono>

namespace clca::grains {

/// `Profile` has a number of seconds for each phase.
template <class Profile>
class PhaseClock {
 public:
  /// Nothing is measured where there is no profile.
  explicit PhaseClock(Profile* profile) : profile_(profile) {
    if (profile_ != nullptr) {
      since_ = Clock::now();
    }
  }

  /// What has passed since the last phase was this one.
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
