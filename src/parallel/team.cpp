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

class Attributes {
 public:
  Attributes() {
    ::pthread_attr_init(&attributes_);
    if (const auto size = stack_size()) {
      ::pthread_attr_setstacksize(&attributes_,
                                  *size);  // refuses what is too small, as OpenMP does
    }
  }
  ~Attributes() { ::pthread_attr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const pthread_attr_t* get() const { return &attributes_; }

 private:
  pthread_attr_t attributes_{};
};

void* wait_at(void* gate) {
  const std::lock_guard lock(*static_cast<std::mutex*>(gate));
  return nullptr;
}

/// What one caller has found startable, another must not take.
std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

/// A child process by fork has one thread, and OpenMP would wait there for the others for ever: its
/// regions have one thread, too.
void prepare_forks() {
  static const int kFailed =
      ::pthread_atfork([] { one_at_a_time().lock(); }, [] { one_at_a_time().unlock(); },
                       [] {
                         one_at_a_time().unlock();
                         ::omp_set_max_active_levels(0);
                       });
  if (kFailed != 0) {
    throw std::bad_alloc();
  }
}

/// How many of `most` threads can exist at once besides this one.
int startable(int most) {
  const Attributes attributes;
  std::mutex gate;
  std::vector<pthread_t> started;
  started.reserve(static_cast<std::size_t>(most));
  {
    const std::lock_guard closed(gate);
    pthread_t thread{};
    while (static_cast<int>(started.size()) < most &&
           ::pthread_create(&thread, attributes.get(), wait_at, &gate) == 0) {
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
  const std::lock_guard lock(one_at_a_time());
  return 1 + startable(wanted - 1);
}

int start_team(int wanted) {
  check(wanted);
  const std::lock_guard lock(one_at_a_time());
  // NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): the region reads it
  const int team = 1 + startable(wanted - 1);
  // Now, as limits may be reached later; regions of the same size then reuse these threads.
  int there = 0;
#pragma omp parallel num_threads(team) reduction(+ : there)
  there += 1;
  prepare_forks();
  return there;
}

}  // namespace clca::parallel
