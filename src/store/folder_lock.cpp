#include "clca/store/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "clca/store/file.hpp"

namespace clca::store {

namespace {

/// What stands in the file: the number of the process that holds it.
std::string holder_of(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  const std::string digits(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  return digits.substr(0, digits.find_first_not_of("0123456789"));
}

/// Whether the file of that name is still the one that is open: the one who held it before may have
/// removed it in the meantime.
bool is_in_place(int descriptor, const std::filesystem::path& file) {
  struct stat held {};
  struct stat named {};
  return ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

[[noreturn]] void refuse_lock(const std::filesystem::path& file, const char* reason) {
  throw StoreError(fmt::format("cannot lock {}: {}", file.string(), reason));
}

/// The file, locked; -1 where it was removed under our hands.
int try_lock(const std::filesystem::path& file) {
  constexpr mode_t kReadableByAll = 0666;  // less what the umask takes away
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kReadableByAll);
  if (descriptor < 0) {
    refuse_lock(file, std::strerror(errno));
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    const std::string holder = holder_of(descriptor);
    ::close(descriptor);
    if (error != EWOULDBLOCK) {
      refuse_lock(file, std::strerror(error));
    }
    throw StoreError(fmt::format("cannot write to {}: another run is at work in it{}",
                                 file.parent_path().string(),
                                 holder.empty() ? "" : fmt::format(" (process {})", holder)));
  }
  if (!is_in_place(descriptor, file)) {
    ::close(descriptor);
    return -1;
  }
  return descriptor;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : file_(folder / "lock") {
  while (descriptor_ < 0) {
    descriptor_ = try_lock(file_);
  }
  const std::string holder = fmt::format("{}\n", ::getpid());
  if (::ftruncate(descriptor_, 0) == 0) {  // the number is for people: it may fail
    [[maybe_unused]] const ssize_t written = ::pwrite(descriptor_, holder.data(), holder.size(), 0);
  }
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) {
    ::unlink(file_.c_str());
    ::close(descriptor_);
  }
}

}  // namespace clca::store
