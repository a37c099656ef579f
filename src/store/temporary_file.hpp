#pragma once
// Files that get their names when they are finished: `.clca-MARK-NUMBER` until then.

#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "store/descriptor.hpp"

namespace clca::store {

/// Part of the names of all temporary files of this process; practically unique.
const std::string& mark_of_process();

/// A new temporary file, locked, and its name. `path` is used in messages. Throws StoreError.
std::pair<Descriptor, std::string> locked_temporary_file(int folder,
                                                         const std::filesystem::path& path);

bool has_temporary_files(int folder);

/// Removes temporary files with these marks, but for those that a process still uses.
void remove_abandoned_files(int folder, const std::set<std::string>& marks);

}  // namespace clca::store
