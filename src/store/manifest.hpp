#pragma once
// The file `.clca.manifest` of an output folder.

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace clca::store {

struct Manifest {
  std::set<std::string> files;
  std::set<std::string> folders;    ///< that clca has made
  std::set<std::string> temporary;  ///< marks in the names of temporary files
};

/// Reads and writes the manifest of the open folder `folder`; `path` stands in messages. Other
/// processes may do the same at any time. All throw StoreError.
class ManifestFile {
 public:
  /// `expected`: there has been a manifest, which must not have been removed.
  ManifestFile(int folder, std::filesystem::path path, bool expected)
      : folder_(folder), path_(std::move(path)), expected_(expected) {}

  /// Empty where there is no manifest. Throws for one that is damaged or names files elsewhere.
  Manifest read() const;
  /// Adds an entry and has it on the disk.
  void add_file(const std::string& name) const { append("file", name); }
  void add_folder(const std::string& name) const { append("folder", name); }
  void add_temporary(const std::string& mark) const { append("temporary", mark); }
  /// Takes a file off the list.
  void remove_file(const std::string& name) const { append("removed", name); }
  /// Puts a new manifest in place: `left`, and what other processes have listed since `seen` was
  /// read.
  void replace(const Manifest& seen, Manifest left) const;
  /// Removes a manifest that lists no file and no folder.
  void remove_if_empty() const;

 private:
  class Locked;
  void append(std::string_view kind, const std::string& name) const;
  /// Writes a file beside the manifest and gives it its name.
  void put(std::string_view text) const;
  [[noreturn]] void refuse(std::string_view what, const char* reason) const;

  int folder_;
  std::filesystem::path path_;
  bool expected_;
};

/// Whether a name stays inside of its output folder: each part is the name of a file.
bool is_inside(std::string_view name);

}  // namespace clca::store
