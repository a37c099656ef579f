#pragma once
// Giving the interpreter up and taking it back while Python may come to its end; signals meanwhile.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <utility>

#include "clca/process/program.hpp"
#include "clca/text/read.hpp"

namespace clca::python {

/// Without the interpreter, as pybind11::gil_scoped_release. CPython ends a thread that wants it
/// back after Python has come to its end, and C++ cannot be unwound so everywhere: such a thread
/// waits for the end of the process.
class Released {
 public:
  Released();
  ~Released();
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

 private:
  PyThreadState* state_;
};

/// Waits for ever if Python comes to its end in another thread. To be called before the interpreter
/// is taken back, for which CPython would end the thread.
void wait_at_end();

/// Python tells when it comes to its end.
void watch_end();

/// Looks for signals, and keeps what their handlers in Python raise.
class Interrupt {
 public:
  const std::atomic<int>* stop() const { return &stop_; }
  /// Does not need the interpreter.
  void look() {
    look([] {});
  }
  /// Also calls `report`, with the interpreter; what it raises ends the work likewise.
  template <class Report>
  void look(Report report) {
    wait_at_end();
    const pybind11::gil_scoped_acquire interpreter;
    if (raised_) {
      return;
    }
    try {
      if (PyErr_CheckSignals() != 0) {
        throw pybind11::error_already_set();
      }
      report();
    } catch (pybind11::error_already_set& error) {
      raised_.emplace(std::move(error));
      stop_ = SIGINT;
    }
  }
  /// look(), some ten times a second.
  void look_now_and_then() {
    if (const auto now = Clock::now(); now >= due_) {
      look();
      due_ = now + kInterval;
    }
  }
  /// As look_now_and_then(). Throws process::StoppedError after a signal whose handler raises.
  void check() {
    look_now_and_then();
    if (stop_ != 0) {
      throw process::StoppedError("stopped by a signal");
    }
  }
  /// Calls `work` without the interpreter, which the caller has; then raises what was kept.
  template <class Work>
  void during(Work work) {
    stop_ = 0;
    try {
      const Released free;
      work();
    } catch (const process::StoppedError&) {  // of a program that was stopped for that reason
      raise();
      throw;
    }
    raise();
  }

 private:
  void raise() {
    if (raised_) {
      throw *std::exchange(raised_, std::nullopt);
    }
  }

  using Clock = std::chrono::steady_clock;
  static constexpr auto kInterval = std::chrono::milliseconds(100);

  std::atomic<int> stop_ = 0;
  std::optional<pybind11::error_already_set> raised_;
  Clock::time_point due_ = Clock::now() + kInterval;
};

/// Marks an object as busy in a scope: changes by a signal handler or another thread are refused
/// meanwhile, also where the lock of the interpreter is released.
class BusyScope {
 public:
  /// `busy` is of the object.
  explicit BusyScope(bool& busy) : busy_(busy) {
    check(busy);
    busy = true;
  }
  ~BusyScope() { busy_ = false; }
  BusyScope(const BusyScope&) = delete;
  BusyScope& operator=(const BusyScope&) = delete;

  static void check(bool busy) {
    if (busy) {
      throw text::InputError("another call is at work on this object");
    }
  }

 private:
  bool& busy_;
};

}  // namespace clca::python
