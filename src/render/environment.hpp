#pragma once
// Driver settings in the environment.

#include <string>

namespace clca::render {

/// The problem with these values of GALLIUM_DRIVER and LP_NATIVE_VECTOR_WIDTH (null: unset), if
/// any. Mesa crashes on unknown values, so they are checked first.
std::string environment_problem(const char* driver, const char* vector_width);

}  // namespace clca::render
