#pragma once
// One run at a time in a folder.

#include <filesystem>

namespace clca::store {

/// Holds the file `.clca.lock` of a folder. The system holds the lock for the process, so that it
/// is gone with it, however that ends. The file is empty and stays.
class FolderLock {
 public:
  /// Throws StoreError when somebody else holds it, with the number of that process where the
  /// system tells it, or when the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace clca::store
