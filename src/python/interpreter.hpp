#pragma once
// Giving the interpreter up and taking it back while Python may come to its end.

#include <pybind11/pybind11.h>

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

/// With the interpreter, as pybind11::gil_scoped_acquire; likewise.
class Acquired {
 public:
  Acquired();
  ~Acquired();
  Acquired(const Acquired&) = delete;
  Acquired& operator=(const Acquired&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Python tells when it comes to its end.
void watch_end();

}  // namespace clca::python
