#pragma once
// A folder that clca writes into, and the list of what it has written there.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clca/store/atomic_file.hpp"

namespace clca::store {

/// What stands in the way of a file that is to be written.
enum class Replace : std::uint8_t {
  own,   ///< only what clca wrote itself, as the manifest says
  named  ///< any regular file: the user has named it; it is not listed in the manifest
};

struct OutputFile;

/// The file `.clca.manifest` lists every file before it is made. Nothing that is not listed is ever
/// replaced or removed, and no symbolic link below the folder is followed. Names are relative, with
/// `/` between folders ("frames/a-000120.png"). Copies share one folder; all functions may be
/// called from several threads. All throw StoreError.
class OutputFolder {
 public:
  /// Writes nothing yet: the folder is made with its first file. Throws for a damaged manifest. An
  /// empty path is the working directory.
  explicit OutputFolder(const std::filesystem::path& path);

  /// The folder `name` in this one; its files are in the same manifest.
  OutputFolder subfolder(const std::string& name) const;

  std::filesystem::path path() const;
  std::filesystem::path path(const std::string& name) const;

  /// Whether the manifest lists the file, be it there or not.
  bool owns(const std::string& name) const;
  /// All files of the manifest in this folder that are there.
  std::vector<std::string> files() const;
  /// Throws where a file of that name is there that the manifest does not list, or where it is no
  /// regular file.
  void require_free(const std::string& name) const;

  void make_folder(const std::string& name) const;
  /// A file that appears when it is finished.
  AtomicFile create(const std::string& name, Replace replace = Replace::own) const;
  void write(const std::string& name, std::span<const std::uint8_t> bytes,
             Replace replace = Replace::own) const;
  void write(const std::string& name, std::string_view text, Replace replace = Replace::own) const;
  /// A file descriptor to add to the end of a file, which is made if need be.
  int open_to_append(const std::string& name) const;
  /// Cuts off what comes after the first `bytes`. Returns false where the file has less. A file
  /// that is not there has no bytes.
  bool truncate(const std::string& name, std::uint64_t bytes) const;
  /// Flushes a file to the disk, if it is there.
  void sync(const std::string& name) const;

  /// Gives a file another name, in place of what had it. Both are files of the manifest.
  void rename(const std::string& from, const std::string& to) const;
  /// Removes a file of the manifest, if it is there.
  void remove(const std::string& name) const;
  /// Removes all files of the manifest but `kept`, then the folders that are empty; `first` before
  /// all others. The manifest lists what is left.
  void clear(const std::string& first, const std::string& kept) const;
  /// Removes temporary files of processes that were killed, as the first file that is written does.
  void remove_temporary_files() const;

 private:
  class State;
  friend OutputFile named_file(const std::filesystem::path& path);
  OutputFolder(std::shared_ptr<State> state, std::string prefix);

  std::shared_ptr<State> state_;
  std::string prefix_;  // empty or ends in a slash
};

/// Where a file is to be written.
struct OutputFile {
  OutputFolder folder;
  std::string name;
  Replace replace = Replace::own;

  AtomicFile create() const { return folder.create(name, replace); }
  std::filesystem::path path() const { return folder.path(name); }
};

/// A file that the user has named. Its folder must be there.
OutputFile named_file(const std::filesystem::path& path);

/// The folder that the user has named or, where `named` is empty, the folder `below` of the run
/// folder `run`.
OutputFolder named_folder(const std::filesystem::path& named, const std::filesystem::path& run,
                          const std::string& below);

}  // namespace clca::store
