#pragma once
// Makes and writes pictures in the background.

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace clca::drawing {

/// Uses a thread of its own if possible and keeps the order of pictures. If a few are waiting the
/// caller waits too, so that memory stays bounded.
class FrameWriter {
 public:
  /// Pictures that wait at most.
  static constexpr int kMaxWaiting = 2;

  FrameWriter();
  /// Does what waits.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Calls `job` once, on that thread. Rethrows the error of an earlier one or, without a thread,
  /// of this one.
  void add(std::function<void()> job);
  /// Waits until all is done. Rethrows likewise.
  void finish();

 private:
  void work();
  void rethrow_failure();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool busy_ = false;
  bool closing_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace clca::drawing
