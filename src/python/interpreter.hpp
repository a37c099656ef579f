#pragma once
// Releases and takes back the interpreter while Python may end; checks signals meanwhile.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <utility>

#include "clca/process/program.hpp"
#include "clca/text/read.hpp"

namespace clca::python {

/// Releases the interpreter in a scope, as pybind11::gil_scoped_release. CPython ends a thread that
/// takes it back after the end of Python, which C++ cannot unwind everywhere: such a thread waits
/// for the end of the process.
class ReleasedInterpreter {
 public:
  ReleasedInterpreter();
  ~ReleasedInterpreter();
  ReleasedInterpreter(const ReleasedInterpreter&) = delete;
  ReleasedInterpreter& operator=(const ReleasedInterpreter&) = delete;

 private:
  PyThreadState* state_;
};

/// Waits for ever if Python comes to its end in another thread. To be called before the interpreter
/// is taken back, for which CPython would end the thread.
void wait_if_python_ends();

/// Python tells when it comes to its end.
void watch_for_python_end();

/// Checks signals, and keeps the exceptions that their handlers in Python raise.
class SignalWatch {
 public:
  const std::atomic<int>* stop_signal() const { return &stop_; }
  /// Does not need the interpreter.
  void check_signals() {
    check_signals([] {});
  }
  /// Also calls `report`, with the interpreter; what it raises ends the work likewise.
  template <class Report>
  void check_signals(Report report) {
    wait_if_python_ends();
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
  /// check_signals(), some ten times a second.
  void check_signals_at_intervals() {
    if (const auto now = Clock::now(); now >= due_) {
      check_signals();
      due_ = now + kInterval;
    }
  }
  /// check_signals_at_intervals(); throws process::StoppedError once a handler has raised.
  void throw_if_stopped() {
    check_signals_at_intervals();
    if (stop_ != 0) {
      throw process::StoppedError("stopped by a signal");
    }
  }
  /// Calls `work` without the interpreter, which the caller has; then raises what was kept.
  template <class Work>
  void run_without_interpreter(Work work) {
    stop_ = 0;
    try {
      const ReleasedInterpreter free;
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
  /// `busy`: a member of the object.
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
