#pragma once
// An off-screen OpenGL context: of OSMesa or, where there is none, of EGL without a
// surface. Only context.cpp depends on them.

#include <memory>
#include <string>

namespace clca::render {

class GlContext {
 public:
  using Function = void (*)();

  GlContext();  ///< throws RenderError, std::bad_alloc
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// An OpenGL function. Throws RenderError when there is none of that name.
  static Function function(const char* name);

  /// Makes it current for this thread, until the returned guard is destroyed.
  [[nodiscard]] std::shared_ptr<void> make_current() const;

 private:
  void* handle_ = nullptr;
};

/// The problem with these values of GALLIUM_DRIVER and LP_NATIVE_VECTOR_WIDTH (null: unset), if
/// any. Mesa crashes on unknown values, so they are checked first.
std::string environment_problem(const char* driver, const char* vector_width);

}  // namespace clca::render
