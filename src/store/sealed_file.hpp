#pragma once
// HDF5 files that are whole or refused: made in memory, sealed by a checksum, checked before HDF5
// looks at them. Any reader of HDF5 opens them; the seal stands in the user block at their begin.

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clca::store {

/// Numbers that a dataset may hold.
template <class T>
concept Number = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint64_t> ||
    std::same_as<T, std::int32_t> || std::same_as<T, float> || std::same_as<T, double>;

/// What a file is for, and the version of its layout, from 1.
struct FileKind {
  std::string_view name;
  std::uint32_t version = 1;
};

/// Collects datasets and attributes. Every path is relative to the root; groups are made on the
/// way. Throws std::runtime_error when HDF5 fails (out of memory).
class SealedWriter {
 public:
  explicit SealedWriter(const FileKind& kind);
  ~SealedWriter();
  SealedWriter(const SealedWriter&) = delete;
  SealedWriter& operator=(const SealedWriter&) = delete;

  /// A dataset of `values` in rows of `columns` numbers (1: a plain list), chunked and compressed.
  template <Number T>
  void add(const std::string& path, std::span<const T> values, std::size_t columns = 1);
  /// A string, as UTF-8.
  void add_text(const std::string& path, std::string_view text);
  /// A list of strings.
  void add_texts(const std::string& path, const std::vector<std::string>& texts);

  /// All bytes of the file. Nothing can be added afterwards.
  std::vector<std::uint8_t> seal();

 private:
  class File;
  std::unique_ptr<File> file_;
};

/// Throws StoreError, with the path of the file, for whatever is not as it should be: cut off,
/// changed, of another kind or a newer version, a dataset that is missing, of other numbers or
/// larger than what memory may hold.
class SealedReader {
 public:
  /// `most_bytes`: that the file and what is read from it may take at any one time.
  SealedReader(std::filesystem::path path, const FileKind& kind, double most_bytes);
  ~SealedReader();
  SealedReader(const SealedReader&) = delete;
  SealedReader& operator=(const SealedReader&) = delete;

  /// Version of the layout that the file has: at most that of the kind.
  std::uint32_t version() const;
  bool has(const std::string& path) const;
  /// Whether there is a dataset of such numbers.
  template <Number T>
  bool holds(const std::string& path) const;
  /// A dataset with rows of `columns` numbers.
  template <Number T>
  std::vector<T> read(const std::string& path, std::size_t columns = 1) const;
  std::string read_text(const std::string& path) const;
  std::vector<std::string> read_texts(const std::string& path) const;

  /// Throws StoreError: `cannot read FILE: REASON`.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  class File;
  std::filesystem::path path_;
  std::unique_ptr<File> file_;
};

}  // namespace clca::store
