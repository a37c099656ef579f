#include "clca/parallel/team.hpp"

#include <omp.h>
#include <pthread.h>

#include <mutex>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace clca::parallel {

namespace {

/// Held while threads are tried or started, so that no other caller takes them.
std::mutex& thread_count_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// In a child process by fork OpenMP would wait for ever for other threads: it gets one thread.
void prepare_forks() {
  static const int kFailed =
      ::pthread_atfork([] { thread_count_mutex().lock(); }, [] { thread_count_mutex().unlock(); },
                       [] {
                         thread_count_mutex().unlock();
                         ::omp_set_max_active_levels(0);
                       });
  if (kFailed != 0) {
    throw std::bad_alloc();
  }
}

/// How many of `most` threads can exist at once besides this one.
int startable_besides(int most) {
  std::mutex gate;
  std::vector<std::jthread> started;
  const std::lock_guard closed(gate);  // until all have been started
  try {
    while (static_cast<int>(started.size()) < most) {
      started.emplace_back([&gate] { const std::lock_guard open(gate); });
    }
  } catch (const std::system_error&) {  // there can be no more
  }
  return static_cast<int>(started.size());
}

void check(int wanted) {
  if (wanted < 1) {
    throw std::invalid_argument("the number of threads must be positive");
  }
}

}  // namespace

int startable_threads(int wanted) {
  check(wanted);
  const std::lock_guard lock(thread_count_mutex());
  return 1 + startable_besides(wanted - 1);
}

int start_team(int wanted) {
  check(wanted);
  const std::lock_guard lock(thread_count_mutex());
  // NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): the region reads it
  const int team = 1 + startable_besides(wanted - 1);
  // Now, as limits may be reached later; regions of the same size then reuse these threads.
  int there = 0;
#pragma omp parallel num_threads(team) reduction(+ : there)
  there += 1;
  prepare_forks();
  return there;
}

}  // namespace clca::parallel
