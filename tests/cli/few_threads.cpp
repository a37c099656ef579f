// Loaded before all else (LD_PRELOAD), lets a program have no more than CLCA_MOST_THREADS threads
// at a time beside its first, as a limit on processes does.

#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

using Start = void* (*)(void*);

struct Call {
  Start start;
  void* argument;
};

std::atomic<int> running = 0;

/// Counts one thread more. Those that are just ending get 100 ms for it, so that tests are certain.
bool may_start(int most) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    int now = running;
    if (now < most && running.compare_exchange_strong(now, now + 1)) {
      return true;
    }
    ::usleep(1000);
  }
  return false;
}

/// Also where a thread ends by pthread_exit.
struct OneLess {
  ~OneLess() { --running; }
};

void* carry_out(void* given) {
  const OneLess at_the_end;
  const Call call = *static_cast<Call*>(given);
  delete static_cast<Call*>(given);
  return call.start(call.argument);
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, Start start,
                              void* argument) {
  static const auto create =
      reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
  static const char* const most = std::getenv("CLCA_MOST_THREADS");
  if (!may_start(most == nullptr ? 0 : std::atoi(most))) {
    return EAGAIN;
  }
  return create(thread, attributes, carry_out, new Call{start, argument});
}
