#pragma once
// A header of 512 bytes: what a file is, how long, and a checksum of it all. It finds what was cut
// off or damaged; it has no key, so who reads a file still has to check all that is in it.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace clca::store {

/// What a file is for, and the version of its layout, from 1.
struct FileKind {
  std::string_view name;
  std::uint32_t version = 1;
};

/// Programs for HDF5 look for its data behind 0, 512, 1024, ... bytes.
inline constexpr std::size_t kHeaderBytes = 512;

/// `content` with its header in front: text that fills up with zeros.
std::vector<std::uint8_t> with_header(const FileKind& kind, std::span<const std::uint8_t> content);

/// What is behind the header of `file`. Throws std::runtime_error with the reason for a file that
/// is cut off, changed, of another kind or another version than `kind`.
std::span<const std::uint8_t> content_of(const FileKind& kind, std::span<const std::uint8_t> file);

}  // namespace clca::store
