#pragma once
// Ctrl-C and other signals while the interpreter is free.

#include <pybind11/pybind11.h>

#include <atomic>
#include <csignal>
#include <optional>
#include <utility>

namespace clca::python {

/// Looks for signals, and keeps what their handlers in Python raise.
class Interrupt {
 public:
  const std::atomic<int>* stop() const { return &stop_; }
  /// Does not need the interpreter.
  void look() {
    const pybind11::gil_scoped_acquire interpreter;
    if (!raised_ && PyErr_CheckSignals() != 0) {
      raised_.emplace();
      stop_ = SIGINT;
    }
  }
  /// Needs the interpreter.
  void raise() {
    if (raised_) {
      throw *std::exchange(raised_, std::nullopt);
    }
  }

 private:
  std::atomic<int> stop_ = 0;
  std::optional<pybind11::error_already_set> raised_;
};

}  // namespace clca::python
