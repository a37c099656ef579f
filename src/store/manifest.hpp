#pragma once
// The file `.clca.manifest` of an output folder.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "store/descriptor.hpp"

namespace clca::store {

struct Manifest {
  std::set<std::string> files;
  std::set<std::string> folders;    ///< that clca has made
  std::set<std::string> temporary;  ///< marks in the names of temporary files

  bool operator==(const Manifest&) const = default;
};

/// Gives a file its name; with `replace` also where another has it. On failure sets errno (EEXIST:
/// the name is taken) and returns false.
using GiveName = std::function<bool(bool replace)>;

/// Reads and writes the manifest of the open folder `folder`; `path` is used in messages. Other
/// processes may do so at any time. All functions throw StoreError.
class ManifestFile {
 public:
  /// `expected`: a manifest existed and must not have been removed.
  ManifestFile(int folder, std::filesystem::path path, bool expected)
      : folder_(folder), path_(std::move(path)), expected_(expected) {}

  /// Empty if there is no manifest. Throws if it is damaged or names files outside the folder.
  Manifest read() const;
  /// Adds entries and syncs them to disk.
  void add_files(const std::set<std::string>& names) const { append("file", names, Sync::yes); }
  /// Adds a file and calls `give` before other processes can list files. If the name is taken, the
  /// entry is withdrawn, and the file replaced if it is listed all the same: another process did
  /// that. Returns whether the file has its name.
  bool add_file(const std::string& name, const GiveName& give) const;
  /// Replaces a file that was listed; one that another process has taken off the list meanwhile is
  /// added.
  bool replace_file(const std::string& name, const GiveName& give) const;
  /// Calls `remove` and takes the file off the list before other processes can list files.
  void remove_file(const std::string& name, const std::function<void()>& remove) const;
  /// Adds an entry without syncing it: what a power failure loses is an empty folder or a temporary
  /// file that stays.
  void add_folder(const std::string& name) const { append("folder", {name}, Sync::no); }
  void add_temporary(const std::string& mark) const { append("temporary", {mark}, Sync::no); }
  /// Removes files from the list.
  void remove_files(const std::set<std::string>& names) const {
    append("removed", names, Sync::yes);
  }
  /// Replaces the manifest by `left` and entries that other processes added since `seen` was read,
  /// or whose files and folders they made again.
  void replace(const Manifest& seen, Manifest left,
               const std::function<bool(const std::string& name)>& is_there) const;
  /// Removes a manifest that lists no file and no folder.
  void remove_if_empty() const;

 private:
  class Locked;
  enum class Sync : std::uint8_t { no, yes };
  void append(std::string_view kind, const std::set<std::string>& names, Sync sync) const;
  /// The open file; not open, with errno, if there is none. May be of a manifest that another
  /// process has replaced.
  Descriptor open(int flags) const;
  /// All of it; empty if there is none.
  std::string text() const;
  /// Writes a temporary file and renames it to the manifest.
  void put(std::string_view text) const;
  [[noreturn]] void refuse(std::string_view what, const char* reason) const;

  int folder_;
  std::filesystem::path path_;
  bool expected_;
};

/// Whether a name stays inside its output folder: each part is a safe file name.
bool is_inside(std::string_view name);

}  // namespace clca::store
