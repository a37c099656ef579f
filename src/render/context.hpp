#pragma once
// An off-screen OpenGL 3.3 core context. Only this file depends on OSMesa; surfaceless EGL could
// replace it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace clca::render {

/// Loads OSMesa, once. Throws RenderError, std::bad_alloc.
void load_library();

class Context {
 public:
  using Function = void (*)();

  /// Throws RenderError.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Address of an OpenGL function, null when there is none of that name.
  static Function function(const char* name);

  /// Makes a context current for this thread during its lifetime.
  class Current {
   public:
    explicit Current(Context& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
  };

 private:
  void* handle_;
  std::array<std::uint8_t, 4> pixel_ = {};  // OSMesa wants a buffer; drawing goes elsewhere
};

/// The problem with these values of GALLIUM_DRIVER and LP_NATIVE_VECTOR_WIDTH (null: unset), if
/// any. Mesa crashes on unknown values, so they are checked first.
std::string environment_problem(const char* driver, const char* vector_width);

/// Throws std::bad_alloc unless so much address space is free: OSMesa, GLib and fontconfig end
/// the program where they get no memory.
void require_memory(std::size_t bytes = std::size_t{128} << 20U);

}  // namespace clca::render
