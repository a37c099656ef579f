#include "memory_meter.hpp"

#include <atomic>

#include "target.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define CLCA_COUNTS_MEMORY 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CLCA_COUNTS_MEMORY 1
#endif
#endif

#ifdef CLCA_COUNTS_MEMORY
// sanitizer/allocator_interface.h, which comes with clang only.
extern "C" {
int __sanitizer_install_malloc_and_free_hooks(void (*taken)(const volatile void*, std::size_t),
                                              void (*given_back)(const volatile void*));
std::size_t __sanitizer_get_allocated_size(const volatile void* block);
}
#endif

namespace clca::fuzz {

namespace {

std::atomic<std::ptrdiff_t> now = 0;
std::atomic<std::ptrdiff_t> most = 0;

#ifdef CLCA_COUNTS_MEMORY

void add(std::ptrdiff_t bytes) {
  const std::ptrdiff_t sum = now += bytes;
  std::ptrdiff_t before = most;
  while (sum > before && !most.compare_exchange_weak(before, sum)) {
  }
}

void taken(const volatile void* /*block*/, std::size_t size) {
  add(static_cast<std::ptrdiff_t>(size));
}

void given_back(const volatile void* block) {
  add(-static_cast<std::ptrdiff_t>(block == nullptr ? 0 : __sanitizer_get_allocated_size(block)));
}

void count() {
  static const bool counts = __sanitizer_install_malloc_and_free_hooks(taken, given_back) != 0;
  require(counts, "memory cannot be counted");
}

#else

void count() {}

#endif

}  // namespace

MemoryMeter::MemoryMeter() {
  count();
  now = 0;
  most = 0;
}

double MemoryMeter::max_bytes() {
  return static_cast<double>(most);
}

}  // namespace clca::fuzz
