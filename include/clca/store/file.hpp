#pragma once
// Reading whole files, and writing files named by the user.

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

/// Writes a file named by the user, replacing any regular file. It appears complete; on StoreError
/// `path` is unchanged.
void write_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_whole(const std::filesystem::path& path, std::string_view text);

/// Makes a folder and its parents, if needed. Throws StoreError.
void make_folder(const std::filesystem::path& folder);

/// Lets files be found that other machines have just made in a folder, or with it. NFS may say for
/// a minute that there is nothing where this machine has looked before.
void look_anew(const std::filesystem::path& folder);

/// All bytes of a regular file. Throws StoreError, also for other kinds of files and more than
/// `max_bytes`.
std::vector<std::uint8_t> read_whole(const std::filesystem::path& path, double max_bytes);

/// Maximum size of a picture file.
inline constexpr double kMaxPictureBytes = 256 << 20;

}  // namespace clca::store
