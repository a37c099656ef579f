#include "clca/store/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "store/descriptor.hpp"

namespace clca::store {

namespace {

/// The id of the process that holds the lock, from /proc/locks; empty if unknown.
std::string holder_of(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    return "";
  }
  const std::string file =
      fmt::format("{:02x}:{:02x}:{}", major(status.st_dev), minor(status.st_dev), status.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    // Number, kind, mode, access, process, file.
    const std::vector<std::string> fields{std::istream_iterator<std::string>(words), {}};
    if (fields.size() > 5 && fields[1] == "FLOCK" && fields[5] == file && fields[4] != "0") {
      return fields[4];
    }
  }
  return "";
}

[[noreturn]] void refuse_lock(const std::filesystem::path& file, const char* reason) {
  throw FolderLockError(fmt::format("cannot lock {}: {}", file.string(), reason));
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".clca.lock";
  constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  Descriptor opened(::open(file.c_str(), kFlags, kReadableByAll));
  if (!opened.is_open()) {
    refuse_lock(file, std::strerror(errno));
  }
  if (!opened.is_regular()) {
    refuse_lock(file, "it is no regular file");
  }
  if (::flock(opened.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) {
      refuse_lock(file, std::strerror(errno));
    }
    const std::string holder = holder_of(opened.number());
    throw FolderInUseError(fmt::format("cannot write to {}: another run is at work in it{}",
                                       folder.string(),
                                       holder.empty() ? "" : fmt::format(" (process {})", holder)));
  }
  descriptor_ = opened.release();
  process_ = ::getpid();
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), process_(other.process_) {}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) {
    if (process_ == ::getpid()) {
      ::flock(descriptor_, LOCK_UN);  // forked children may have the descriptor, too
    }
    ::close(descriptor_);
  }
}

}  // namespace clca::store
