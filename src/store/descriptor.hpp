#pragma once
// File descriptors.

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "process/internal/write_all.hpp"

namespace clca::store {

inline constexpr mode_t kReadableByAll = 0666;  // less what the umask takes away

/// Closes a file descriptor at the end of a scope.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
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

using process::write_all;

}  // namespace clca::store
