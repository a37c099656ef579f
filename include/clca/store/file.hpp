#pragma once
// Files: read, and written so that they appear complete or not at all. Locks of folders.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace clca::store {

/// A file or folder that cannot be read or written. what() is one line with the path and why.
class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline std::span<const std::uint8_t> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Writes to a temporary file beside the target until finish(); without finish() that is removed
/// and the old file stays. All functions throw StoreError; nothing can be written after that.
/// Copies share the file.
class AtomicFile {
 public:
  /// A file named by the user. Its folder must exist, and what has its name be a regular file.
  explicit AtomicFile(const std::filesystem::path& path);

  /// Another program may write to this path instead of write().
  std::filesystem::path temporary_path() const;
  void write(std::span<const std::uint8_t> bytes);  ///< appends
  void write(std::string_view text) { write(as_bytes(text)); }
  std::uint64_t size() const;  ///< bytes written at the end
  void flush();                ///< to the disk, now
  void finish();               ///< flushes, unless its folder delays that, and renames

 private:
  friend class OutputFolder;
  struct State;
  /// `flush_later`: called after the renaming of an unflushed file; none: it is flushed before.
  AtomicFile(const std::filesystem::path& path, std::function<void()> flush_later);

  std::shared_ptr<State> state_;
};

/// Removes temporary files of killed processes.
void remove_abandoned_files(const std::filesystem::path& folder);

/// Writes a file named by the user, replacing any regular file. It appears complete; on StoreError
/// `path` is unchanged.
void write_whole_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
inline void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  write_whole_file(path, as_bytes(text));
}

/// Makes a folder and its parents, if needed. Throws StoreError.
void make_folder(const std::filesystem::path& folder);

/// Makes files visible that other machines have just made in a folder, or with it: NFS may hide
/// them for a minute where this machine has looked before.
void refresh_folder(const std::filesystem::path& folder);

/// All bytes of a regular file. Throws StoreError, also for other kinds of files and more than
/// `max_bytes`.
std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& path, double max_bytes);

/// A folder cannot be locked, since nothing can be written in it.
class FolderLockError : public StoreError {
 public:
  using StoreError::StoreError;
};

class FolderInUseError : public FolderLockError {
 public:
  using FolderLockError::FolderLockError;
};

/// Locks the file `.clca.lock` of a folder; copies share the lock. The system releases the lock
/// when the process ends, and children that it has forked meanwhile. The file is empty and remains.
class FolderLock {
 public:
  /// Throws FolderInUseError if another process holds the lock, with its id if known, and
  /// FolderLockError if the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  std::shared_ptr<void> held_;  // unlocks it at the end
};

inline constexpr double kMaxPictureBytes = 256 << 20;

}  // namespace clca::store
