#pragma once

#include <cstddef>

namespace clca::render {

/// Throws std::bad_alloc unless so much address space is free: OSMesa, GLib and fontconfig end
/// the program where they get no memory.
void require_memory(std::size_t bytes = std::size_t{128} << 20U);

}  // namespace clca::render
