#pragma once
// Files written piece by piece that appear complete or not at all.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

namespace clca::store {

/// Writes to a temporary file beside the target until finish(); without finish() that is removed
/// and the old file stays. All functions throw StoreError; nothing can be written after that.
class AtomicFile {
 public:
  /// A file named by the user. Its folder must exist, and what has its name be a regular file.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;

  /// Another program may write to this path instead of write().
  std::filesystem::path temporary_path() const;
  /// Appends.
  void write(std::span<const std::uint8_t> bytes);
  void write(std::string_view text);
  std::uint64_t size() const;  ///< bytes written at the end
  /// To the disk, now.
  void flush();
  /// Flushes, unless its folder delays that, and renames.
  void finish();

 private:
  friend class OutputFolder;
  struct State;
  /// `flush_later`: called once it has its name, if it is not flushed yet; none: it is before.
  AtomicFile(const std::filesystem::path& path, std::function<void()> flush_later);

  std::unique_ptr<State> state_;
};

/// Removes temporary files of killed processes.
void remove_abandoned_files(const std::filesystem::path& folder);

}  // namespace clca::store
