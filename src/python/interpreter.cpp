#include "python/interpreter.hpp"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace clca::python {

namespace {

/// The end of Python in this process.
struct End {
  std::atomic<bool> is_near = false;
  std::atomic<std::thread::id> thread;  ///< the one that goes on
  std::atomic<int> at_work = 0;         ///< threads without the interpreter

  static End& get() {
    static End end;
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
void come_to_end() {
  using namespace std::chrono_literals;
  constexpr int kTries = 3000;
  End& end = End::get();
  end.thread = std::this_thread::get_id();
  end.is_near = true;
  const pybind11::gil_scoped_release free;
  for (int tries = 0; end.at_work > release_depth() && tries < kTries; ++tries) {
    std::this_thread::sleep_for(1ms);
  }
}

/// The other threads are not in the child.
void forked() {
  End::get().at_work = release_depth();
}

}  // namespace

void wait_at_end() {
  End& end = End::get();
  if (end.is_near && end.thread.load() != std::this_thread::get_id()) {
    end.at_work -= release_depth() > 0 ? 1 : 0;
    for (;;) {
      ::pause();
    }
  }
}

Released::Released() : state_(PyEval_SaveThread()) {
  ++release_depth();
  ++End::get().at_work;
  wait_at_end();
}

Released::~Released() {
  wait_at_end();
  PyEval_RestoreThread(state_);
  --release_depth();
  --End::get().at_work;
}

void watch_end() {
  pthread_atfork(nullptr, nullptr, forked);
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(come_to_end));
}

}  // namespace clca::python
