#pragma once
// The OpenGL functions used here, loaded by name, with a few wrappers.

#include <GL/glcorearb.h>

#include <cstddef>
#include <initializer_list>

#include "render/context.hpp"

// Name without "gl", and the type of the function.
#define CLCA_GL_FUNCTIONS(X)                          \
  X(AttachShader, ATTACHSHADER)                       \
  X(BindBuffer, BINDBUFFER)                           \
  X(BindFramebuffer, BINDFRAMEBUFFER)                 \
  X(BindRenderbuffer, BINDRENDERBUFFER)               \
  X(BindVertexArray, BINDVERTEXARRAY)                 \
  X(BufferData, BUFFERDATA)                           \
  X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS)   \
  X(Clear, CLEAR)                                     \
  X(ClearColor, CLEARCOLOR)                           \
  X(CompileShader, COMPILESHADER)                     \
  X(CreateProgram, CREATEPROGRAM)                     \
  X(CreateShader, CREATESHADER)                       \
  X(DeleteShader, DELETESHADER)                       \
  X(Disable, DISABLE)                                 \
  X(DrawElementsInstanced, DRAWELEMENTSINSTANCED)     \
  X(Enable, ENABLE)                                   \
  X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY) \
  X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER) \
  X(GenBuffers, GENBUFFERS)                           \
  X(GenFramebuffers, GENFRAMEBUFFERS)                 \
  X(GenRenderbuffers, GENRENDERBUFFERS)               \
  X(GenVertexArrays, GENVERTEXARRAYS)                 \
  X(GetError, GETERROR)                               \
  X(GetIntegerv, GETINTEGERV)                         \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG)             \
  X(GetProgramiv, GETPROGRAMIV)                       \
  X(GetShaderInfoLog, GETSHADERINFOLOG)               \
  X(GetShaderiv, GETSHADERIV)                         \
  X(GetUniformLocation, GETUNIFORMLOCATION)           \
  X(LinkProgram, LINKPROGRAM)                         \
  X(ReadPixels, READPIXELS)                           \
  X(RenderbufferStorage, RENDERBUFFERSTORAGE)         \
  X(Scissor, SCISSOR)                                 \
  X(ShaderSource, SHADERSOURCE)                       \
  X(Uniform1f, UNIFORM1F)                             \
  X(Uniform2f, UNIFORM2F)                             \
  X(Uniform4f, UNIFORM4F)                             \
  X(UseProgram, USEPROGRAM)                           \
  X(VertexAttribDivisor, VERTEXATTRIBDIVISOR)         \
  X(VertexAttribIPointer, VERTEXATTRIBIPOINTER)       \
  X(VertexAttribPointer, VERTEXATTRIBPOINTER)         \
  X(Viewport, VIEWPORT)

namespace clca::render {

/// OpenGL objects live as long as their context and are not deleted one by one.
struct Gl {
  /// Needs a current context. Throws RenderError when a function is missing.
  Gl();

#define CLCA_GL_DECLARE(name, type) PFNGL##type##PROC name = nullptr;
  CLCA_GL_FUNCTIONS(CLCA_GL_DECLARE)
#undef CLCA_GL_DECLARE

  GLint integer(GLenum name) const;
  GLuint buffer() const;
  GLuint vertex_array() const;
  /// Compiles a program from the parts of two shaders in GLSL 3.30. Throws RenderError with the
  /// compiler's message.
  using Source = std::initializer_list<const char*>;
  GLuint program(Source vertex, Source fragment) const;
  /// Throws RenderError with `what` if OpenGL has reported an error.
  void check(const char* what) const;
};

}  // namespace clca::render
