#pragma once
// Files written piece by piece that appear complete or not at all.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace clca::store {

/// Made by OutputFolder::create(). Writes to a temporary file beside it until finish(); without
/// finish() that is removed and the old file stays.
/// All functions throw StoreError; nothing can be written after that.
class AtomicFile {
 public:
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
  explicit AtomicFile(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace clca::store
