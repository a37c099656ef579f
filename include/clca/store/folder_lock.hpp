#pragma once
// One run at a time in a folder.

#include <filesystem>

namespace clca::store {

/// Holds the file `lock` of a folder, in which stands the number of the process. It is the system
/// that holds it: a lock goes with the process, however that ends.
class FolderLock {
 public:
  /// Throws StoreError when somebody else holds it, with the number of that process, or when the
  /// file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace clca::store
