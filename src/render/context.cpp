#include "render/context.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include "clca/render/painter.hpp"
#include "render/environment.hpp"

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

}  // namespace clca::render
