#pragma once
// File descriptors, and what system calls on them need.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

namespace clca::store {

inline constexpr mode_t kNewFileMode = 0666;  // less what the umask takes away

/// Throws StoreError: `cannot WHAT PATH: REASON`.
[[noreturn]] void fail(std::string_view what, const std::filesystem::path& path,
                       std::string_view reason = std::strerror(errno));

/// Closes a file descriptor at the end of a scope.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  FileDescriptor(FileDescriptor&& other) noexcept : number_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (number_ >= 0) {
      const int error = errno;  // of the call whose failure ends the scope
      ::close(number_);
      errno = error;
    }
  }
  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  bool is_regular() const {
    struct stat status {};
    return ::fstat(number_, &status) == 0 && S_ISREG(status.st_mode);
  }
  int release() { return std::exchange(number_, -1); }
  /// Closes and reports delayed write errors (full disk, quota).
  bool close() { return ::close(release()) == 0; }

 private:
  int number_;
};

/// Writes all bytes to a file descriptor; false after an error, which is in errno.
inline bool write_all(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  return true;
}

}  // namespace clca::store
