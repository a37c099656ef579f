#pragma once
// A function in a child process: a crash, an endless loop or a failed allocation there leaves this
// program as it is.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <thread>

#include "clca/process/program.hpp"

namespace clca::process {

/// A child that has failed. what() is the text of the exception that it threw, or how it ended:
/// "crashed (signal 11)".
class ChildError : public ProcessError {
 public:
  ChildError(const std::string& what, bool crashed) : ProcessError(what), crashed_(crashed) {}
  /// By a signal, or at the limit of processor time: not by an exception.
  bool crashed() const { return crashed_; }

 private:
  bool crashed_;
};

struct ChildLimits {
  double memory_bytes = 1e18;  ///< that it may allocate; without effect under a sanitizer
  unsigned cpu_seconds = 10;   ///< processor time
};

class Child {
 public:
  using Send = std::function<void(std::span<const std::uint8_t>)>;

  /// Forks. The child calls work(send) and ends; receive() gives what it sends. Where other threads
  /// run, `work` must not wait for a lock that they may hold (allocating is safe); it must not
  /// start threads. Signals from the terminal do not reach the child. Under a sanitizer, where
  /// there are other threads, `work` runs in a thread of this process. Throws ProcessError.
  Child(const std::function<void(const Send&)>& work, const ChildLimits& limits);
  /// Ends it if it still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Fills `bytes` with the next that it sends. Throws ChildError where it ends before.
  void receive(std::span<std::uint8_t> bytes);
  /// Waits for its end. Throws ChildError where it failed or sends more.
  void finish();

 private:
  std::size_t read_some(std::span<std::uint8_t> bytes) const;
  int wait();
  [[noreturn]] void fail(int status) const;

  ChildLimits limits_;
  int child_ = -1;         // process id; -1 when it has ended
  int output_ = -1;        // file descriptor
  int error_ = -1;         // likewise: the text of its exception
  std::thread thread_;     // in place of the child
  int thread_status_ = 0;  // as of waitpid
};

}  // namespace clca::process
