#pragma once
// Signals and warnings while the interpreter is free.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clca/process/program.hpp"
#include "clca/text/input_error.hpp"
#include "python/interpreter.hpp"

namespace clca::python {

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
    const Acquired interpreter;
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
  /// The same some ten times a second.
  void look_at_times() {
    if (const auto now = Clock::now(); now >= due_) {
      look();
      due_ = now + kInterval;
    }
  }
  /// As look_at_times(). Throws process::StoppedError after a signal whose handler raises.
  void check() {
    look_at_times();
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

/// While an object is being changed, with the interpreter or without: other changes, by a signal
/// handler or another thread, are refused.
class Change {
 public:
  /// `busy` is of the object.
  explicit Change(bool& busy) : busy_(busy) {
    check(busy);
    busy = true;
  }
  ~Change() { busy_ = false; }
  Change(const Change&) = delete;
  Change& operator=(const Change&) = delete;

  static void check(bool busy) {
    if (busy) {
      throw text::InputError("another call is at work on this object");
    }
  }

 private:
  bool& busy_;
};

/// Keeps warnings, to be those of Python.
class Warnings {
 public:
  std::function<void(const std::string&)> take() {
    return [this](const std::string& text) { texts_.push_back(text); };
  }
  /// Needs the interpreter.
  void issue() const {
    for (const std::string& text : texts_) {
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 2) != 0) {
        throw pybind11::error_already_set();
      }
    }
  }

 private:
  std::vector<std::string> texts_;
};

}  // namespace clca::python
