#pragma once
// Runs a function in a child process: a crash, an endless loop or a failed allocation there does
// not affect this process.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <thread>

#include "clca/process/program.hpp"

namespace clca::process {

/// A failed child. what() is the text of its exception, or how it ended: "crashed (signal 11)".
class ChildError : public ProcessError {
 public:
  ChildError(const std::string& what, bool crashed) : ProcessError(what), crashed_(crashed) {}
  /// True if it ended by a signal or at its time limit, not by an exception.
  bool crashed() const { return crashed_; }

 private:
  bool crashed_;
};

struct ChildLimits {
  double memory_bytes = 1e18;  ///< that it may allocate; no effect with a sanitizer
  unsigned cpu_seconds = 10;   ///< processor time
};

class Child {
 public:
  using Send = std::function<void(std::span<const std::uint8_t>)>;

  /// Forks. The child calls work(send) and ends; receive() returns what it sends. Throws
  /// ProcessError.
  /// `work` must not start threads or wait for locks of other threads (allocation is safe). It gets
  /// no terminal signals.
  /// With a sanitizer and other threads present, `work` runs in a thread of this process instead.
  Child(const std::function<void(const Send&)>& work, const ChildLimits& limits);
  /// Ends the child if it is still running.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Fills `bytes` with the next bytes sent. Throws ChildError if the child ends before.
  void receive(std::span<std::uint8_t> bytes);
  /// Waits for its end. Throws ChildError if it failed or sent more.
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
