#pragma once
// An exception must not leave a parallel region of OpenMP by itself: the program would end.

#include <atomic>
#include <exception>

namespace clca::parallel {

/// Carries the first exception out of a parallel region. Once something has failed the work of all
/// threads is skipped, so that they still reach the barriers and the end of the region.
class FirstFailure {
 public:
  /// Does the work unless something has failed before. For any thread of the region.
  template <class Work>
  void guard(Work work) noexcept {
    if (failed()) {
      return;
    }
    try {
      work();
    } catch (...) {
      if (!failed_.exchange(true)) {
        first_ = std::current_exception();
      }
    }
  }
  bool failed() const { return failed_.load(std::memory_order_relaxed); }
  /// After the region: throws what was caught first, if anything was.
  void rethrow() const {
    if (first_) {
      std::rethrow_exception(first_);
    }
  }

 private:
  std::atomic<bool> failed_ = false;
  std::exception_ptr first_;
};

}  // namespace clca::parallel
