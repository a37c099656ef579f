#pragma once
// One run at a time in a folder.

#include <filesystem>

#include "clca/store/file.hpp"

namespace clca::store {

/// A folder in which nothing can be written.
class FolderLockError : public StoreError {
 public:
  using StoreError::StoreError;
};

/// Another process is at work in a folder.
class FolderInUseError : public FolderLockError {
 public:
  using FolderLockError::FolderLockError;
};

/// Locks the file `.clca.lock` of a folder. The system releases the lock when the process ends, and
/// children that it has forked meanwhile. The file is empty and remains.
class FolderLock {
 public:
  /// Throws FolderInUseError if another process holds the lock, with its id if known, and
  /// FolderLockError if the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int descriptor_ = -1;
  int process_ = 0;  // that has locked it
};

}  // namespace clca::store
