#pragma once
// Files that are written piece by piece and yet appear whole or not at all.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace clca::store {

class Descriptor;

/// Stands aside until finish(). Without that `path` is as it was and nothing is left beside it. All
/// throw StoreError; nothing can be written after that.
class WholeFile {
 public:
  explicit WholeFile(std::filesystem::path path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Where it stands until then: another program may write there, too.
  const std::filesystem::path& aside() const { return aside_; }
  /// At the end.
  void write(std::span<const std::uint8_t> bytes);
  void write(std::string_view text);
  /// In place of the first bytes, which must have been written.
  void rewrite_begin(std::span<const std::uint8_t> bytes);
  std::uint64_t size() const { return size_; }  ///< bytes written at the end
  /// Flushes to the disk and renames.
  void finish();

 private:
  [[noreturn]] void fail() const;  // as errno says

  std::filesystem::path path_;
  std::filesystem::path aside_;  // empty when there is nothing to remove
  std::unique_ptr<Descriptor> file_;
  std::uint64_t size_ = 0;
};

}  // namespace clca::store
