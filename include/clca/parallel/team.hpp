#pragma once
// Threads of OpenMP regions where the system limits their number; exceptions out of regions.

#include <atomic>
#include <exception>

namespace clca::parallel {

/// How many threads can exist, the calling one included: at least 1 and at most `wanted`. None is
/// left running. Throws std::invalid_argument unless `wanted` is positive.
int startable_threads(int wanted);

/// Starts `wanted` threads for the regions of the calling thread, the calling one included, or as
/// many as the system allows; OpenMP would end the program on failure. Regions of a child process
/// by fork have one thread. Returns the number of threads, at least 1. Throws std::invalid_argument
/// unless `wanted` is positive.
int start_team(int wanted);

/// Carries the first exception out of a parallel region, which would end the program. After a
/// failure all threads skip their work but still reach the barriers.
class FirstFailure {
 public:
  /// Runs `work` unless something has failed. Any thread of the region may call it.
  template <class Work>
  void guard(Work work) noexcept {
    if (has_failed()) {
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
  bool has_failed() const { return failed_.load(std::memory_order_relaxed); }
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
