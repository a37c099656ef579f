#pragma once
// Reading a whole file from an untrusted source.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace clca::text {

/// Why a file cannot be read, without its name: `No such file or directory`.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a regular file. Does not block on devices, pipes or sockets.
/// Throws ReadError for anything but a regular file and for more than `max_bytes`, even if the
/// file grows while it is read.
std::vector<std::uint8_t> read_file(const std::filesystem::path& file, double max_bytes);

/// Whether `text` is safe as a file name, or its beginning: a single path component, no leading
/// dot, no control characters, at most 200 bytes.
bool is_file_name(std::string_view text);

}  // namespace clca::text
