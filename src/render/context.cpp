#include "render/context.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <cstdlib>
#include <mutex>
#include <new>
#include <string_view>

#include "clca/render/painter.hpp"

namespace clca::render {

namespace {

/// OSMesa, loaded before the first picture: it brings LLVM, which takes longer to load than many a
/// run without pictures takes.
struct Library {
  void* handle = load();
  decltype(&OSMesaCreateContextAttribs) create = function<decltype(create)>("CreateContextAttribs");
  decltype(&OSMesaDestroyContext) destroy = function<decltype(destroy)>("DestroyContext");
  decltype(&OSMesaMakeCurrent) make_current = function<decltype(make_current)>("MakeCurrent");
  decltype(&OSMesaGetProcAddress) address = function<decltype(address)>("GetProcAddress");

  static const Library& get() {
    static const Library kLibrary;  // to the end of the process
    return kLibrary;
  }

 private:
  static void* load() {
    require_memory(kLibraryBytes);
    void* handle = ::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
      throw RenderError(fmt::format("cannot load OSMesa, which draws pictures: {}", ::dlerror()));
    }
    return handle;
  }
  template <class Pointer>
  Pointer function(const char* name) const {
    void* found = ::dlsym(handle, fmt::format("OSMesa{}", name).c_str());
    if (found == nullptr) {
      throw RenderError(fmt::format("OSMesa has no {}", name));
    }
    return reinterpret_cast<Pointer>(found);
  }
  static constexpr std::size_t kLibraryBytes = std::size_t{384} << 20U;
};

OSMesaContext create() {
  prepare_environment();
  require_memory();
  constexpr std::array<int, 13> kAttributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_DEPTH_BITS,
                                               0,
                                               OSMESA_STENCIL_BITS,
                                               0,
                                               OSMESA_PROFILE,
                                               OSMESA_CORE_PROFILE,
                                               OSMESA_CONTEXT_MAJOR_VERSION,
                                               3,
                                               OSMESA_CONTEXT_MINOR_VERSION,
                                               3,
                                               0};
  return Library::get().create(kAttributes.data(), nullptr);
}

}  // namespace

void load_library() {
  Library::get();
}

Context::Context() : handle_(create()) {
  if (handle_ == nullptr) {
    throw RenderError("OSMesa gives no OpenGL 3.3 core context");
  }
}

Context::~Context() {
  Library::get().destroy(static_cast<OSMesaContext>(handle_));
}

Context::Function Context::function(const char* name) {
  return Library::get().address(name);
}

Context::Current::Current(Context& context) {
  require_memory();
  if (Library::get().make_current(static_cast<OSMesaContext>(context.handle_),
                                  context.pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
    throw RenderError("OSMesa cannot use its OpenGL context");
  }
}

Context::Current::~Current() {
  Library::get().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
}

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
