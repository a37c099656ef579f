#pragma once

#include <cstdint>
#include <span>

namespace clca::process {

/// Writes all bytes to a file descriptor; false after an error, which is in errno.
bool write_all(int descriptor, std::span<const std::uint8_t> bytes);

}  // namespace clca::process
