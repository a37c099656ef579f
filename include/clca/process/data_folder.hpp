#pragma once
// Where the data of the program lie.

#include <array>
#include <filesystem>

namespace clca::process {

/// Folders that may hold the data named `what` (plots, scenes): that installed with this program,
/// then that in the source tree it was built from.
std::array<std::filesystem::path, 2> data_folders(const std::filesystem::path& what);

}  // namespace clca::process
