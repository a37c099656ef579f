#pragma once
// Reading whole files, and writing those that the user has named.

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace clca::store {

/// A file or folder that cannot be read or written. what() is one line with the path and why.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file that the user has named, in place of any regular file there. It appears when it is
/// whole. Throws StoreError; then `path` is as it was.
void write_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_whole(const std::filesystem::path& path, std::string_view text);

/// Makes a folder, and those that it lies in, if need be. Throws StoreError.
void make_folder(const std::filesystem::path& folder);

/// All bytes of a regular file, and of nothing else. Throws StoreError, also for more than
/// `most_bytes`.
std::vector<std::uint8_t> read_whole(const std::filesystem::path& path, double most_bytes);

/// Most bytes of a picture that is read.
inline constexpr double kMostPictureBytes = 256 << 20;

}  // namespace clca::store
