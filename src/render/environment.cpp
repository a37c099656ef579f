#include "render/environment.hpp"

#include <fmt/format.h>
#include <sys/mman.h>

#include <cstdlib>
#include <mutex>
#include <new>
#include <string_view>

#include "clca/render/painter.hpp"
#include "render/context.hpp"

namespace clca::render {

std::string environment_problem(const char* driver, const char* vector_width) {
  const std::string_view name = driver == nullptr ? "" : driver;
  if (!name.empty() && name != "llvmpipe" && name != "softpipe") {
    return fmt::format(
        "GALLIUM_DRIVER is \"{}\"; pictures are drawn with llvmpipe or softpipe: unset it", name);
  }
  const std::string_view width = vector_width == nullptr ? "128" : vector_width;
  if (width != "128" && width != "256") {
    return fmt::format("LP_NATIVE_VECTOR_WIDTH is \"{}\"; 128 and 256 work: unset it", width);
  }
  return {};
}

void require_memory(std::size_t bytes) {
  void* room = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) {
    throw std::bad_alloc();
  }
  ::munmap(room, bytes);
}

void prepare_environment() {
  static std::mutex mutex;  // setenv races with itself
  const std::lock_guard lock(mutex);
  const std::string problem =
      environment_problem(std::getenv("GALLIUM_DRIVER"), std::getenv("LP_NATIVE_VECTOR_WIDTH"));
  if (!problem.empty()) {
    throw RenderError(problem);
  }
  if (std::getenv("LP_NUM_THREADS") == nullptr) {
    setenv("LP_NUM_THREADS", "0", 0);
  }
  load_library();
}

}  // namespace clca::render
