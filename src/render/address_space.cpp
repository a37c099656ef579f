#include "render/address_space.hpp"

#include <sys/mman.h>

#include <new>

namespace clca::render {

void require_memory(std::size_t bytes) {
  void* room = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) {
    throw std::bad_alloc();
  }
  ::munmap(room, bytes);
}

}  // namespace clca::render
