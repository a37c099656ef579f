#pragma once
// What the drivers need: settings in the environment, and memory.

#include <cstddef>
#include <string>

namespace clca::render {

/// The problem with these values of GALLIUM_DRIVER and LP_NATIVE_VECTOR_WIDTH (null: unset), if
/// any. Mesa crashes on unknown values, so they are checked first.
std::string environment_problem(const char* driver, const char* vector_width);

/// Throws std::bad_alloc unless so much address space is free: OSMesa, GLib and fontconfig end
/// the program where they get no memory.
void require_memory(std::size_t bytes = std::size_t{128} << 20U);

}  // namespace clca::render
