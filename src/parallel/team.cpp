#include "clca/parallel/team.hpp"

#include <omp.h>
#include <pthread.h>

#include <cctype>
#include <cstdlib>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace clca::parallel {

namespace {

/// Stack size requested by the environment, in bytes: a number of kibibytes, or with the unit B, K,
/// M or G.
std::optional<std::size_t> stack_size() {
  constexpr unsigned kKibi = 10;
  const char* text = std::getenv("OMP_STACKSIZE");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  if (text == nullptr) {
    return std::nullopt;
  }
  char* end = nullptr;
  const unsigned long long number = std::strtoull(text, &end, 10);
  while (std::isspace(static_cast<unsigned char>(*end)) != 0) {
    ++end;
  }
  const std::size_t unit = std::string_view("BKMG").find(
      *end == '\0' ? 'K' : static_cast<char>(std::toupper(static_cast<unsigned char>(*end))));
  if (end == text || unit == std::string_view::npos) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(number) << (kKibi * unit);
}

/// Attributes of threads that are started as OpenMP starts its own.
class ThreadAttributes {
 public:
  ThreadAttributes() {
    ::pthread_attr_init(&attributes_);
    if (const auto size = stack_size()) {
      ::pthread_attr_setstacksize(&attributes_,
                                  *size);  // refuses what is too small, as OpenMP does
    }
  }
  ~ThreadAttributes() { ::pthread_attr_destroy(&attributes_); }
  ThreadAttributes(const ThreadAttributes&) = delete;
  ThreadAttributes& operator=(const ThreadAttributes&) = delete;
  const pthread_attr_t* get() const { return &attributes_; }

 private:
  pthread_attr_t attributes_{};
};

void* wait_until_open(void* gate) {
  const std::lock_guard lock(*static_cast<std::mutex*>(gate));
  return nullptr;
}

/// Held while threads are tried or started: what one caller has found startable, another must not
/// take.
std::mutex& thread_count_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// A child process by fork has one thread, and OpenMP would wait there for the others for ever: its
/// regions have one thread, too.
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
  const ThreadAttributes attributes;
  std::mutex gate;
  std::vector<pthread_t> started;
  started.reserve(static_cast<std::size_t>(most));
  {
    const std::lock_guard closed(gate);
    pthread_t thread{};
    while (static_cast<int>(started.size()) < most &&
           ::pthread_create(&thread, attributes.get(), wait_until_open, &gate) == 0) {
      started.push_back(thread);
    }
  }
  for (const pthread_t thread : started) {
    ::pthread_join(thread, nullptr);
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
