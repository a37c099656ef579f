#pragma once
// Calls in the background.

#include <functional>
#include <future>
#include <system_error>
#include <utility>

namespace clca::tasks {

/// Makes one call at a time, on a thread of its own if one can be had; for writing while the caller
/// goes on. At its end it waits for the call.
class BackgroundCall {
 public:
  /// Waits until the call before has ended. Rethrows what that one has thrown.
  void start(std::function<void()> call) {
    finish();
    call_ = std::move(call);
    try {
      ended_ = std::async(std::launch::async, std::ref(call_));
    } catch (const std::system_error&) {  // no more threads can be had
      call_();
    }
  }
  /// Waits until the call has ended. Rethrows its exception.
  void finish() {
    if (ended_.valid()) {
      ended_.get();
    }
    call_ = nullptr;
  }

 private:
  std::function<void()> call_;
  std::future<void> ended_;  // last: at the end it waits for the call
};

}  // namespace clca::tasks
