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
  ManifestFile(int folder, std::filesystem::path path) : folder_(folder), path_(std::move(path)) {}

  /// Empty where there is no manifest. Throws for one that is damaged or names files elsewhere.
  Manifest read() const;
  /// Adds an entry and has it on the disk.
  void add_file(const std::string& name) const { append("file", name); }
  void add_folder(const std::string& name) const { append("folder", name); }
  void add_temporary(const std::string& mark) const { append("temporary", mark); }
  /// Puts a new manifest in place; it is written to `temporary` first.
  void replace(const Manifest& manifest, const std::string& temporary) const;
  /// Removes a manifest that lists nothing but this mark.
  void remove_if_only(const std::string& mark) const;

 private:
  class Locked;
  void append(std::string_view kind, const std::string& name) const;

  int folder_;
  std::filesystem::path path_;
};

/// Whether a name stays inside of its output folder: each part is the name of a file.
bool is_inside(std::string_view name);

}  // namespace clca::store
