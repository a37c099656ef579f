#pragma once
// Settings of the OpenGL driver that come from the environment of the process.

#include <string>

namespace clca::render {

/// What is wrong with these values of GALLIUM_DRIVER and LP_NATIVE_VECTOR_WIDTH (null: unset), or
/// nothing. Mesa crashes on values it does not know, so they are looked at before it starts.
std::string environment_problem(const char* driver, const char* vector_width);

}  // namespace clca::render
