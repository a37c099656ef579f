#pragma once
// An exception that leaves an OpenMP region ends the program. This class carries it out.

#include <atomic>
#include <exception>

namespace clca::parallel {

/// Carries the first exception out of a parallel region. After a failure all threads skip their
/// work but still reach the barriers.
class FirstFailure {
 public:
  /// Runs `work` unless something has failed. Any thread of the region may call it.
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
  /// After the region: rethrows the first exception, if any.
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
