#pragma once
// The seal of a file: 512 bytes in front that say what it is, how long, and a checksum of it all.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "store/sealed_file.hpp"

namespace clca::store {

/// Readers of HDF5 look for it behind 0, 512, 1024, ... bytes.
inline constexpr std::size_t kSealBytes = 512;

/// The seal of `content`, text that fills up with zeros.
std::vector<std::uint8_t> seal_of(const FileKind& kind, std::span<const std::uint8_t> content);

/// The version that the seal of `file` gives. Throws std::runtime_error with the reason for a file
/// that is cut off, changed, of another kind or newer than `kind`.
std::uint32_t check_seal(const FileKind& kind, std::span<const std::uint8_t> file);

}  // namespace clca::store
