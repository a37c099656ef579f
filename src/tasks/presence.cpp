#include "clca/tasks/presence.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace clca::tasks {

namespace {

struct flock byte_of(int rank) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = rank;
  lock.l_len = 1;
  return lock;
}

/// A rank of an earlier command may be about to end.
bool lock(int file, int rank) {
  constexpr int kTries = 500;
  constexpr useconds_t kPause = 10'000;
  for (int i = 0; i < kTries; ++i) {
    struct flock byte = byte_of(rank);
    if (::fcntl(file, F_OFD_SETLK, &byte) == 0) {
      return true;
    }
    if (errno != EAGAIN && errno != EACCES && errno != EINTR) {
      return false;
    }
    ::usleep(kPause);
  }
  return false;
}

}  // namespace

Presence::Presence(const std::filesystem::path& file, int rank) {
  constexpr mode_t kReadableByAll = 0666;
  constexpr int kFlags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  file_ = ::open(file.c_str(), rank == 0 ? kFlags | O_CREAT : kFlags, kReadableByAll);
  if (file_ < 0 || !lock(file_, rank)) {
    const std::error_code error(errno, std::generic_category());
    ::close(file_);
    throw std::system_error(error, "cannot lock " + file.string());
  }
}

Presence::~Presence() {
  ::close(file_);
}

bool Presence::has(int rank) const {
  struct flock byte = byte_of(rank);
  return ::fcntl(file_, F_OFD_GETLK, &byte) == 0 && byte.l_type != F_UNLCK;
}

}  // namespace clca::tasks
