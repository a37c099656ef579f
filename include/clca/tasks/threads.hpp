#pragma once
// Threads that each make one call at a time.

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace clca::tasks {

class Threads {
 public:
  /// Starts as many threads as are wanted, or as the system allows. start() makes the call itself
  /// if no thread could be started, or if `inline_one` and `wanted` is 1.
  /// Each thread calls `begin` first, and none makes a call before all have; without any, the
  /// caller does, but not for `inline_one`.
  explicit Threads(std::size_t wanted, bool inline_one = false,
                   const std::function<void()>& begin = {});
  /// Waits for the calls that are under way.
  ~Threads();
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  /// Calls at a time, at least 1.
  std::size_t count() const { return threads_.empty() ? 1 : threads_.size(); }
  /// Whether start() makes the calls itself.
  bool are_inline() const { return threads_.empty(); }
  /// Calls that can be started now.
  std::size_t idle() const;
  /// One that does not throw; idle() must not be 0.
  void start(std::function<void()> call);
  /// Waits until a call has ended since the last time, but not longer than `most`.
  void wait(std::chrono::microseconds most);

 private:
  void work(const std::function<void()>& begin);

  mutable std::mutex mutex_;  // of all below but the threads
  std::condition_variable started_;
  std::condition_variable ended_;
  std::size_t begun_ = 0;                     // threads
  std::vector<std::function<void()>> calls_;  // that no thread has begun
  std::size_t under_way_ = 0;                 // with those
  bool has_ended_ = false;                    // a call, since the last wait
  bool over_ = false;
  std::vector<std::thread> threads_;
};

/// Makes one call at a time, on a thread of its own if one can be had; for writing while the caller
/// goes on. At its end it waits for the call.
class Background {
 public:
  /// Waits until the call before has ended. Rethrows what that one has thrown.
  void start(std::function<void()> call);
  /// Likewise, without another call.
  void finish();

 private:
  std::function<void()> call_;
  std::future<void> ended_;  // last: at the end it waits for the call
};

}  // namespace clca::tasks
