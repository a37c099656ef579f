#pragma once
// All of a file, whoever wrote it.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace clca::text {

/// Why a file cannot be read, without its name: `No such file or directory`.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a regular file. Throws ReadError, also for anything else that can be opened (a
/// folder, device, pipe or socket), without waiting for it, and for more than `most_bytes`, even
/// where the file grows while it is read.
std::vector<std::uint8_t> read_file(const std::filesystem::path& file, double most_bytes);

}  // namespace clca::text
