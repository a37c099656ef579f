#include "store/folder_tree.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>

#include "clca/store/file.hpp"

namespace clca::store {

namespace {

namespace fs = std::filesystem;

constexpr int kFolderFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

Descriptor folder_in(const Descriptor& folder, const std::string& name) {
  return Descriptor(::openat(folder.number(), name.c_str(), kFolderFlags));
}

Descriptor file_in(const Descriptor& folder, const std::string& leaf) {
  constexpr int kFlags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  return Descriptor(folder.is_open() ? ::openat(folder.number(), leaf.c_str(), kFlags) : -1);
}

/// Calls `enter` with "a", "a/b", ... for the folders of the file "a/b/c", until it returns false.
template <class Enter>
void for_each_folder(const std::string& name, Enter enter) {
  const std::string below = folder_and_leaf(name).first;
  for (std::size_t end = 0; end < below.size(); ++end) {
    end = std::min(below.find('/', end), below.size());
    if (!enter(below.substr(0, end))) {
      return;
    }
  }
}

}  // namespace

void fail_at(const char* what, const fs::path& path, const char* reason) {
  throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), reason));
}

std::pair<std::string, std::string> folder_and_leaf(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? std::pair(std::string(), name)
                                    : std::pair(name.substr(0, slash), name.substr(slash + 1));
}

Found found_in(int folder, const std::string& leaf) {
  struct stat status {};
  if (::fstatat(folder, leaf.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    return Found::nothing;
  }
  return S_ISREG(status.st_mode) ? Found::file : Found::other;
}

void FolderTree::open() {
  const char* path = path_.empty() ? "." : path_.c_str();
  root_ = Descriptor(::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

void FolderTree::make() {
  store::make_folder(path_);
  open();
  if (!is_open()) {
    fail_at("write to", path_, std::strerror(errno));
  }
}

Descriptor FolderTree::parent(const std::string& name) const {
  Descriptor folder = is_open() ? folder_in(root_, ".") : Descriptor();
  for_each_folder(name, [&](const std::string& below) {
    if (folder.is_open()) {
      folder = folder_in(folder, folder_and_leaf(below).second);
    }
    return folder.is_open();
  });
  return folder;
}

Descriptor FolderTree::make_parent(const std::string& name,
                                   const std::function<void(const std::string&)>& made) const {
  Descriptor folder = folder_in(root_, ".");
  for_each_folder(name, [&](const std::string& below) {
    if (!folder.is_open()) {
      return false;
    }
    const std::string leaf = folder_and_leaf(below).second;
    if (::mkdirat(folder.number(), leaf.c_str(), 0777) == 0) {
      made(below);
    } else if (errno != EEXIST) {
      fail_at("make the folder", path_ / below, std::strerror(errno));
    }
    folder = folder_in(folder, leaf);
    if (!folder.is_open() && (errno == ELOOP || errno == ENOTDIR)) {
      fail_at("write to", path_ / below,
              "it is no folder, or a symbolic link, which is not followed");
    }
    return true;
  });
  if (!folder.is_open()) {
    fail_at("write to", (path_ / name).parent_path(), std::strerror(errno));
  }
  return folder;
}

Found FolderTree::find(const std::string& name) const {
  const Descriptor folder = parent(name);
  return folder.is_open() ? found_in(folder.number(), folder_and_leaf(name).second)
                          : Found::nothing;
}

void FolderTree::remove(const std::string& name) const {
  const Descriptor folder = parent(name);
  if (!folder.is_open() && errno != ENOENT && errno != ENOTDIR && errno != ELOOP) {
    fail_at("remove", path_ / name, std::strerror(errno));
  }
  const std::string leaf = folder_and_leaf(name).second;
  if (folder.is_open() && found_in(folder.number(), leaf) == Found::file &&
      ::unlinkat(folder.number(), leaf.c_str(), 0) != 0 && errno != ENOENT) {
    fail_at("remove", path_ / name, std::strerror(errno));
  }
}

bool FolderTree::remove_folder(const std::string& name) const {
  const Descriptor folder = parent(name);
  return !folder.is_open() ||
         ::unlinkat(folder.number(), folder_and_leaf(name).second.c_str(), AT_REMOVEDIR) == 0 ||
         errno == ENOENT;
}

void FolderTree::flush(const std::set<std::string>& names) const {
  const auto open = [this](const std::string& name) {
    Descriptor file = file_in(parent(name), folder_and_leaf(name).second);
    if (!file.is_open() && errno != ENOENT) {
      fail_at("write", path_ / name, std::strerror(errno));
    }
    return file;
  };
  for (const std::string& name : names) {  // all on their way before the first is waited for
    ::sync_file_range(open(name).number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  }
  for (const std::string& name : names) {
    const Descriptor file = open(name);
    if (file.is_open() && ::fsync(file.number()) != 0) {
      fail_at("write", path_ / name, std::strerror(errno));
    }
  }
}

}  // namespace clca::store
