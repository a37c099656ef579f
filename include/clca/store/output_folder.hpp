#pragma once
// A folder that clca writes to, and text files in it that grow during a run.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clca/store/file.hpp"

namespace clca::store {

/// A folder is clca's if it has the file `.clca.manifest`, which lists the names that clca has
/// given in it: it may replace and remove files of these names. Symbolic links below the folder are
/// not followed. Names are relative, with `/` between folders ("frames/a-000120.png"). Copies share
/// one folder. Thread-safe. All functions throw StoreError.
class OutputFolder {
 public:
  /// Writes nothing: the folder is made with its first file. Throws for a damaged manifest. An
  /// empty path is the working directory.
  explicit OutputFolder(const std::filesystem::path& path);

  /// The folder `name` in this one, with the same manifest.
  OutputFolder subfolder(const std::string& name) const;

  std::filesystem::path path() const;
  std::filesystem::path path(const std::string& name) const;

  /// Throws if clca did not make the folder and there are files in it. One of the name `beside` may
  /// be there.
  void require_clca_folder(const std::string& beside = "") const;
  /// As require_clca_folder(), then makes the folder, if needed, and the manifest.
  void make_clca_folder(const std::string& beside = "") const;
  /// Whether the manifest lists the file, and it is there.
  bool owns(const std::string& name) const;
  /// All existing files of the manifest in this folder.
  std::vector<std::string> listed_files() const;

  void make_folder(const std::string& name) const;
  AtomicFile create(const std::string& name) const;  ///< a file that appears when it is finished
  void write(const std::string& name, std::span<const std::uint8_t> bytes) const;
  void write(const std::string& name, std::string_view text) const { write(name, as_bytes(text)); }
  /// From now on files are renamed before they are flushed to the disk; flush() flushes them.
  void delay_flushing() const;
  void flush() const;  ///< flushes all that was written since the last call to the disk

  /// Renames a file, if it exists, replacing `to`.
  void rename(const std::string& from, const std::string& to) const;
  void remove(const std::string& name) const;  ///< removes a file of the manifest, if it exists
  /// Removes all files of the manifest except `kept`, with `first` first, then empty folders.
  void clear(const std::string& first, const std::string& kept) const;

 private:
  friend class GrowingFile;
  struct State;
  /// Lists a file in the manifest and makes its folders; returns its path.
  std::filesystem::path prepare_file(const std::string& name) const;
  /// Truncates the file to `bytes`, unless it has fewer.
  void truncate(const std::string& name, std::uint64_t bytes) const;
  /// Flushes this file, if it exists, with the next flush().
  void flush_later(const std::string& name) const;

  std::shared_ptr<State> state_;
  std::string prefix_;  // empty or ends in a slash
};

/// The folder named by the user, which must be clca's or empty, or, if `named` is empty, the folder
/// `below` in the run folder `run`. Throws StoreError.
OutputFolder named_folder(const std::filesystem::path& named, const std::filesystem::path& run,
                          const std::string& below);

/// A file that text is appended to, and that no other process writes. When a run resumes, text
/// written after its checkpoint is cut off.
class GrowingFile {
 public:
  /// Keeps the first `kept` bytes of the file, whoever has put it there; it is made with the first
  /// append. Throws as check_kept_bytes().
  GrowingFile(OutputFolder folder, std::string name, std::uint64_t kept);
  /// Throws UnusableCheckpointError unless the first `kept` bytes of the file are there and end a
  /// line.
  static void check_kept_bytes(const OutputFolder& folder, const std::string& name,
                               std::uint64_t kept);

  /// Is on the disk after OutputFolder::flush(). Throws StoreError.
  void append(std::string_view text);
  std::uint64_t size_in_bytes() const { return bytes_; }

 private:
  OutputFolder folder_;
  std::string name_;
  std::uint64_t bytes_;
};

}  // namespace clca::store
