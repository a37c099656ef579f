#include "store/temporary_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <random>
#include <string_view>
#include <vector>

#include "store/folder_tree.hpp"

namespace clca::store {

namespace {

constexpr std::string_view kTemporary = ".clca-";

std::string new_name() {
  static std::atomic<std::uint64_t> count = 0;
  return fmt::format("{}{}-{}", kTemporary, mark_of_process(), ++count);
}

std::vector<std::string> temporary_names(int folder) {
  std::vector<std::string> names;
  Descriptor copy = opened_anew(folder);
  DIR* stream = copy.is_open() ? ::fdopendir(copy.number()) : nullptr;
  if (stream == nullptr) {
    return names;
  }
  copy.release();
  while (const dirent* entry = ::readdir(stream)) {
    if (std::string_view(entry->d_name).starts_with(kTemporary)) {
      names.emplace_back(entry->d_name);
    }
  }
  ::closedir(stream);
  return names;
}

/// Removes a temporary file unless a process still uses it. NFS locks for writing only what is open
/// for writing.
void remove_if_abandoned(int folder, const std::string& name) {
  const Descriptor file(
      ::openat(folder, name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.is_open() && file.is_regular() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0) {
    ::unlinkat(folder, name.c_str(), 0);
  }
}

}  // namespace

const std::string& mark_of_process() {
  static const std::string kMark = [] {
    std::random_device device;
    return fmt::format("{:08x}{:08x}", device(), device());
  }();
  return kMark;
}

std::pair<Descriptor, std::string> locked_temporary_file(int folder,
                                                         const std::filesystem::path& path) {
  constexpr int kMost = 20;
  for (int tries = 1;; ++tries) {
    std::string name = new_name();
    Descriptor file(::openat(folder, name.c_str(),
                             O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kReadableByAll));
    struct stat status {};
    const bool locked = file.is_open() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0 &&
                        ::fstat(file.number(), &status) == 0;
    if (locked && (status.st_nlink > 0 || tries == kMost)) {
      return {std::move(file), std::move(name)};
    }
    // Before it was locked, another process may have taken it for abandoned.
    if (!locked && (tries == kMost || (errno != EWOULDBLOCK && errno != ESTALE))) {
      fail_at("write", path, std::strerror(errno));
    }
  }
}

bool has_temporary_files(int folder) {
  return !temporary_names(folder).empty();
}

void remove_abandoned_files(int folder, const std::set<std::string>& marks) {
  if (marks.empty()) {
    return;
  }
  for (const std::string& name : temporary_names(folder)) {
    const std::size_t end = name.rfind('-');
    if (end > kTemporary.size() &&
        marks.contains(name.substr(kTemporary.size(), end - kTemporary.size()))) {
      remove_if_abandoned(folder, name);
    }
  }
}

}  // namespace clca::store
