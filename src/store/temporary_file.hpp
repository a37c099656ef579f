#pragma once
// Files that get their names when they are finished: `.clca-MARK-NUMBER` until then.

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "clca/store/atomic_file.hpp"
#include "store/descriptor.hpp"
#include "store/manifest.hpp"

namespace clca::store {

/// Part of the names of all temporary files of this process; practically unique.
const std::string& mark_of_process();

/// A new temporary file, locked, and its name. `path` is used in messages. Throws StoreError.
std::pair<Descriptor, std::string> locked_temporary_file(int folder,
                                                         const std::filesystem::path& path);

bool has_temporary_files(int folder);

/// Removes temporary files with these marks, but for those that a process still uses.
void remove_abandoned_files(int folder, const std::set<std::string>& marks);

struct AtomicFile::State {
  State() = default;
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::filesystem::path path;  ///< for messages
  Descriptor folder;
  std::string name;       ///< in the folder
  std::string temporary;  ///< likewise; empty when there is nothing to remove
  Descriptor file;
  /// Lists the file, unless the user has named it, and gives it its name.
  std::function<bool(const GiveName& give)> list_and_name;
  /// Called once it has its name, if it is not flushed yet; none: it is flushed before.
  std::function<void()> flush_later;
  bool flushed = false;
  std::uint64_t size = 0;
};

/// Gives a file an unused name in its folder. On failure sets errno and returns false.
bool rename_without_replacing(int folder, const std::string& from, const std::string& to);

/// `cannot write PATH: clca did not write the file that is there; ...`
[[noreturn]] void refuse_foreign(const std::filesystem::path& path);

}  // namespace clca::store
