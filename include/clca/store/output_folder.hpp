#pragma once
// A folder that clca writes to, and the manifest of the files written.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clca/store/atomic_file.hpp"

namespace clca::store {

/// Which existing files may be replaced.
enum class Replace : std::uint8_t {
  own,   ///< only what clca wrote itself, as the manifest says
  named  ///< any regular file: the user has named it; it is not listed in the manifest
};

struct OutputFile;

/// The file `.clca.manifest` lists every file before it gets its name. Only listed files are
/// replaced or removed, and symbolic links below the folder are not followed. Names are relative,
/// with `/` between folders ("frames/a-000120.png"). Copies share one folder. Thread-safe. All
/// functions throw StoreError.
class OutputFolder {
 public:
  /// Writes nothing: the folder is made with its first file. Throws for a damaged manifest. An
  /// empty path is the working directory.
  explicit OutputFolder(const std::filesystem::path& path);

  /// The folder `name` in this one, with the same manifest.
  OutputFolder subfolder(const std::string& name) const;

  std::filesystem::path path() const;
  std::filesystem::path path(const std::string& name) const;

  /// Whether the manifest lists the file, present or not.
  bool owns(const std::string& name) const;
  /// All existing files of the manifest in this folder.
  std::vector<std::string> files() const;
  /// Throws if a file of that name exists that is not in the manifest or is no regular file.
  void require_free(const std::string& name) const;

  /// Lists files that are going to be written, at once. Until they are, files of these names are
  /// not its own. What is not written in the lifetime of this object is taken off the list again.
  void plan(const std::set<std::string>& names) const;

  void make_folder(const std::string& name) const;
  /// A file that appears when it is finished.
  AtomicFile create(const std::string& name, Replace replace = Replace::own) const;
  void write(const std::string& name, std::span<const std::uint8_t> bytes,
             Replace replace = Replace::own) const;
  void write(const std::string& name, std::string_view text, Replace replace = Replace::own) const;
  /// A file descriptor for appending; makes the file if needed. Call flush_later() when done.
  int open_to_append(const std::string& name) const;
  /// Truncates the file to `bytes`. Returns false if it has fewer. A missing file has no bytes.
  bool truncate(const std::string& name, std::uint64_t bytes) const;
  /// From now on files get their names before they are on the disk, which flush() sees to.
  void delay_flushing() const;
  /// Flushes this file, if it exists, with the next flush().
  void flush_later(const std::string& name) const;
  /// Flushes all that was written since the last call to the disk.
  void flush() const;

  /// Renames a file, replacing `to`. Both are in the manifest.
  void rename(const std::string& from, const std::string& to) const;
  /// Removes a file of the manifest, if it exists.
  void remove(const std::string& name) const;
  /// Removes all files of the manifest except `kept`, with `first` first, then empty folders.
  /// Updates the manifest.
  void clear(const std::string& first, const std::string& kept) const;
  /// Removes temporary files of killed processes, as does writing the first file.
  void remove_temporary_files() const;

 private:
  class State;
  friend OutputFile named_file(const std::filesystem::path& path);
  OutputFolder(std::shared_ptr<State> state, std::string prefix);

  std::shared_ptr<State> state_;
  std::string prefix_;  // empty or ends in a slash
};

/// The target of a file to be written.
struct OutputFile {
  OutputFolder folder;
  std::string name;
  Replace replace = Replace::own;

  AtomicFile create() const { return folder.create(name, replace); }
  std::filesystem::path path() const { return folder.path(name); }
};

/// A file named by the user. Its folder must exist.
OutputFile named_file(const std::filesystem::path& path);

/// The folder named by the user or, if `named` is empty, the folder `below` in the run folder
/// `run`.
OutputFolder named_folder(const std::filesystem::path& named, const std::filesystem::path& run,
                          const std::string& below);

}  // namespace clca::store
