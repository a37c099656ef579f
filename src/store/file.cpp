#include "clca/store/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "clca/text/read.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kTemporaryBegin = ".clca-";
constexpr std::string_view kTemporaryEnd = ".part";

fs::path new_temporary_name() {
  static std::random_device device;
  return fmt::format("{}{:08x}{:08x}{}", kTemporaryBegin, device(), device(), kTemporaryEnd);
}

/// `flags`: LOCK_NB, or 0 to wait.
bool lock(const FileDescriptor& file, int flags) {
  int result = 0;
  do {
    result = ::flock(file.number(), LOCK_EX | flags);
  } while (result != 0 && errno == EINTR);
  return result == 0;
}

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

[[noreturn]] void refuse_lock(const fs::path& file, const char* reason) {
  throw FolderLockError(fmt::format("cannot lock {}: {}", file.string(), reason));
}

}  // namespace

void fail(std::string_view what, const fs::path& path, std::string_view reason) {
  throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), reason));
}

struct AtomicFile::State {
  State() = default;
  ~State() {
    if (!temporary.empty()) {
      ::unlink(temporary.c_str());
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  fs::path path;
  fs::path temporary;  ///< empty when there is nothing to remove
  FileDescriptor file;
  std::function<void()> flush_later;
  bool flushed = false;
  std::uint64_t size = 0;
};

AtomicFile::AtomicFile(const fs::path& path) : AtomicFile(path, nullptr) {
  remove_abandoned_files(path.parent_path());
}

AtomicFile::AtomicFile(const fs::path& path, std::function<void()> flush_later)
    : state_(std::make_shared<State>()) {
  std::error_code error;
  state_->path = fs::absolute(path, error);
  const fs::file_status status = fs::symlink_status(state_->path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    fail("write", path, "it is not a regular file");
  }
  state_->flush_later = std::move(flush_later);
  struct stat made {};
  do {  // before it is locked, another process may lock it as abandoned, and remove it
    const fs::path temporary = state_->path.parent_path() / new_temporary_name();
    constexpr int kFlags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC;
    state_->file = FileDescriptor(::open(temporary.c_str(), kFlags, kNewFileMode));
    if (!state_->file.is_open()) {
      fail("write", path);
    }
    state_->temporary = temporary;
    if (!lock(state_->file, 0) || ::fstat(state_->file.number(), &made) != 0) {
      fail("write", path);
    }
  } while (made.st_nlink == 0);
}

fs::path AtomicFile::temporary_path() const {
  return state_->temporary;
}

std::uint64_t AtomicFile::size() const {
  return state_->size;
}

void AtomicFile::write(std::span<const std::uint8_t> bytes) {
  if (!write_all(state_->file.number(), bytes)) {
    fail("write", state_->path);
  }
  state_->size += bytes.size();
  state_->flushed = false;
}

void AtomicFile::flush() {
  if (::fsync(state_->file.number()) != 0) {
    fail("write", state_->path);
  }
  state_->flushed = true;
}

void AtomicFile::finish() {
  State& state = *state_;
  const bool later = !state.flushed && state.flush_later;
  if (!state.flushed && !later) {
    flush();
  }
  if (::rename(state.temporary.c_str(), state.path.c_str()) != 0) {
    fail("write", state.path);
  }
  state.temporary.clear();
  if (!state.file.close()) {
    fail("write", state.path);
  }
  if (later) {
    state.flush_later();
  }
}

void remove_abandoned_files(const fs::path& folder) {
  std::error_code error;
  const fs::path place = folder.empty() ? "." : folder;
  for (fs::directory_iterator it(place, error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with(kTemporaryBegin) && name.ends_with(kTemporaryEnd)) {
      const FileDescriptor file(
          ::open(it->path().c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
      if (file.is_open() && file.is_regular() && lock(file, LOCK_NB)) {
        ::unlink(it->path().c_str());
      }
    }
  }
}

void write_whole_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.finish();
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    fail("make the folder", folder, error.message());
  }
}

void refresh_folder(const fs::path& folder) {
  for (const fs::path& directory : {folder.parent_path(), folder}) {
    // To open a folder asks the server.
    const FileDescriptor opened(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  }
}

std::vector<std::uint8_t> read_whole_file(const fs::path& path, double max_bytes) {
  try {
    return text::read_file(path, max_bytes);
  } catch (const text::ReadError& error) {
    fail("read", path, error.what());
  }
}

FolderLock::FolderLock(const fs::path& folder) {
  const fs::path file = folder / ".clca.lock";
  constexpr int kFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  FileDescriptor opened(::open(file.c_str(), kFlags, kNewFileMode));
  if (!opened.is_open()) {
    refuse_lock(file, std::strerror(errno));
  }
  if (!opened.is_regular()) {
    refuse_lock(file, "it is no regular file");
  }
  if (!lock(opened, LOCK_NB)) {
    if (errno != EWOULDBLOCK) {
      refuse_lock(file, std::strerror(errno));
    }
    const std::string holder = holder_of(opened.number());
    throw FolderInUseError(fmt::format("cannot write to {}: another run is at work in it{}",
                                       folder.string(),
                                       holder.empty() ? "" : fmt::format(" (process {})", holder)));
  }
  held_ = {nullptr, [number = opened.release(), process = ::getpid()](std::nullptr_t) {
             if (process == ::getpid()) {
               ::flock(number, LOCK_UN);  // forked children may have the descriptor, too
             }
             ::close(number);
           }};
}

}  // namespace clca::store
