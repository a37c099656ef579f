#pragma once
// A header of 512 bytes: kind, length and checksum of a file. Detects truncation and damage.
// It is not a signature, so readers still check all content.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace clca::store {

/// Purpose of a file and version of its layout, from 1.
struct FileKind {
  std::string_view name;
  std::uint32_t version = 1;
};

/// HDF5 programs look for their data at 0, 512, 1024, ... bytes.
inline constexpr std::size_t kHeaderBytes = 512;

/// `content` preceded by its header: text padded with zeros.
std::vector<std::uint8_t> with_header(const FileKind& kind, std::span<const std::uint8_t> content);

/// The content after the header of `file`. Throws std::runtime_error with the reason if it is
/// truncated, damaged, or of another kind or version.
std::span<const std::uint8_t> content_of(const FileKind& kind, std::span<const std::uint8_t> file);

}  // namespace clca::store
