#include "render/gl.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "clca/render/painter.hpp"

namespace clca::render {

namespace {

template <class Pointer>
void load(Pointer& pointer, const char* name) {
  pointer = reinterpret_cast<Pointer>(Context::function(name));
  if (pointer == nullptr) {
    throw RenderError(fmt::format("the OpenGL driver has no {}", name));
  }
}

GLuint compiled(const Gl& gl, GLenum stage, Gl::Source source) {
  std::vector<const char*> parts = {"#version 330 core\n"};
  parts.insert(parts.end(), source.begin(), source.end());
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
  gl.CompileShader(shader);
  GLint done = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done != GL_TRUE) {
    std::string log(1024, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw RenderError(fmt::format("a shader does not compile: {}", log));
  }
  return shader;
}

}  // namespace

Gl::Gl() {
#define CLCA_GL_LOAD(name, type) load(name, "gl" #name);
  CLCA_GL_FUNCTIONS(CLCA_GL_LOAD)
#undef CLCA_GL_LOAD
}

GLint Gl::integer(GLenum name) const {
  GLint value = 0;
  GetIntegerv(name, &value);
  return value;
}

GLuint Gl::buffer() const {
  GLuint name = 0;
  GenBuffers(1, &name);
  return name;
}

GLuint Gl::vertex_array() const {
  GLuint name = 0;
  GenVertexArrays(1, &name);
  return name;
}

GLuint Gl::program(Source vertex, Source fragment) const {
  const GLuint result = CreateProgram();
  for (const GLuint shader :
       {compiled(*this, GL_VERTEX_SHADER, vertex), compiled(*this, GL_FRAGMENT_SHADER, fragment)}) {
    AttachShader(result, shader);
    DeleteShader(shader);
  }
  LinkProgram(result);
  GLint done = GL_FALSE;
  GetProgramiv(result, GL_LINK_STATUS, &done);
  if (done != GL_TRUE) {
    std::string log(1024, '\0');
    GLsizei length = 0;
    GetProgramInfoLog(result, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    throw RenderError(fmt::format("a shader program does not link: {}", log));
  }
  return result;
}

void Gl::check(const char* what) const {
  const GLenum error = GetError();
  if (error == GL_OUT_OF_MEMORY) {
    throw RenderError(fmt::format("no memory for {}", what));
  }
  if (error != GL_NO_ERROR) {
    throw RenderError(fmt::format("OpenGL error {:#06x} at {}", error, what));
  }
}

}  // namespace clca::render
