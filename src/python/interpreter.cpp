#include "python/interpreter.hpp"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace clca::python {

namespace {

struct PythonEnd {
  std::atomic<bool> is_near = false;
  std::atomic<std::thread::id> thread;  ///< the one that goes on
  std::atomic<int> at_work = 0;         ///< threads without the interpreter

  static PythonEnd& get() {
    static PythonEnd end;
    return end;
  }
};

/// How many times this thread has given the interpreter up and not yet taken it back.
int& release_depth() {
  thread_local int count = 0;
  return count;
}

/// Those at work look for signals now and then, and so get here. What they use, such as the HDF5
/// library, must not end before.
void note_python_end() {
  using namespace std::chrono_literals;
  constexpr int kTries = 3000;
  PythonEnd& end = PythonEnd::get();
  end.thread = std::this_thread::get_id();
  end.is_near = true;
  const pybind11::gil_scoped_release free;
  for (int tries = 0; end.at_work > release_depth() && tries < kTries; ++tries) {
    std::this_thread::sleep_for(1ms);
  }
}

/// The other threads are not in the child.
void reset_in_child() {
  PythonEnd::get().at_work = release_depth();
}

}  // namespace

void wait_if_python_ends() {
  PythonEnd& end = PythonEnd::get();
  if (end.is_near && end.thread.load() != std::this_thread::get_id()) {
    end.at_work -= release_depth() > 0 ? 1 : 0;
    for (;;) {
      ::pause();
    }
  }
}

ReleasedInterpreter::ReleasedInterpreter() : state_(PyEval_SaveThread()) {
  ++release_depth();
  ++PythonEnd::get().at_work;
  wait_if_python_ends();
}

ReleasedInterpreter::~ReleasedInterpreter() {
  wait_if_python_ends();
  PyEval_RestoreThread(state_);
  --release_depth();
  --PythonEnd::get().at_work;
}

void watch_for_python_end() {
  pthread_atfork(nullptr, nullptr, reset_in_child);
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(note_python_end));
}

}  // namespace clca::python
