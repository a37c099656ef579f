#pragma once
// Files below one folder, by relative names, never through a symbolic link.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "store/descriptor.hpp"

namespace clca::store {

/// Throws StoreError: `cannot WHAT PATH: REASON`.
[[noreturn]] void fail_at(const char* what, const std::filesystem::path& path, const char* reason);

/// "frames/a.png" is "a.png" in "frames"; "a.png" is in "".
std::pair<std::string, std::string> folder_and_leaf(const std::string& name);

enum class Found : std::uint8_t { nothing, file, other };

/// What a folder has under a name without slashes.
Found found_in(int folder, const std::string& leaf);

/// Names are relative, with `/` between folders. Knows nothing of who made a file. Calls may come
/// from several threads at once, but for open() and make().
class FolderTree {
 public:
  /// Opens the folder, if it exists; otherwise errno says why not. An empty path is the working
  /// directory.
  explicit FolderTree(std::filesystem::path path) : path_(std::move(path)) { open(); }

  const std::filesystem::path& path() const { return path_; }
  bool is_open() const { return root_.is_open(); }
  /// The folder itself.
  int number() const { return root_.number(); }
  void open();
  /// Makes the folder and its parents if needed, and opens it. Throws StoreError.
  void make();

  /// The folder of the file `name`; not open, with errno, if it does not exist or is reached only
  /// through a symbolic link.
  Descriptor parent(const std::string& name) const;
  /// The same, made if needed; `made` gets the name of each folder that is. Throws StoreError.
  Descriptor make_parent(const std::string& name,
                         const std::function<void(const std::string&)>& made) const;
  Found find(const std::string& name) const;
  /// Removes a regular file, if there is one. Throws StoreError.
  void remove(const std::string& name) const;
  /// False if there is such a folder and it cannot be removed, as it is not empty.
  bool remove_folder(const std::string& name) const;
  /// Waits until these files are on the disk, as far as they exist. Throws StoreError.
  void flush(const std::set<std::string>& names) const;

 private:
  std::filesystem::path path_;
  Descriptor root_;
};

}  // namespace clca::store
