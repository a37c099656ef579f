#include "python/interpreter.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace clca::python {

namespace {

/// Of this process.
struct End {
  std::atomic<bool> is_near = false;
  std::atomic<std::thread::id> thread;  ///< the one that goes on
  std::atomic<int> takers = 0;          ///< threads that wait for the interpreter

  static End& get() {
    static End end;
    return end;
  }
};

template <class Take>
void take_interpreter(Take take) {
  End& end = End::get();
  ++end.takers;
  if (end.is_near && end.thread.load() != std::this_thread::get_id()) {
    --end.takers;
    for (;;) {
      ::pause();
    }
  }
  take();
  --end.takers;
}

/// Those that wait already get the interpreter now; no more will wait for it.
void come_to_end() {
  using namespace std::chrono_literals;
  End& end = End::get();
  end.thread = std::this_thread::get_id();
  end.is_near = true;
  const pybind11::gil_scoped_release free;
  for (int tries = 0; end.takers > 0 && tries < 1000; ++tries) {  // those before a fork never come
    std::this_thread::sleep_for(1ms);
  }
}

}  // namespace

Released::~Released() {
  take_interpreter([this] { PyEval_RestoreThread(state_); });
}

Acquired::Acquired() {
  take_interpreter([this] { state_ = PyGILState_Ensure(); });
}

Acquired::~Acquired() {
  PyGILState_Release(state_);
}

void watch_end() {
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(come_to_end));
}

}  // namespace clca::python
