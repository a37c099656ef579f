#pragma once
// Where the data of the program lie.

#include <filesystem>
#include <map>
#include <string>

namespace clca::process {

/// The folder with the data named `what` (python, scenes): share/clca/WHAT in the nearest folder
/// above this program, or above the shared library that has this function; where there is none, the
/// one of the prefix that was built for.
std::filesystem::path data_folder(const std::filesystem::path& what);

/// Python: $CLCA_PYTHON, that of the system, or the first one on the PATH. Throws ProcessError.
std::filesystem::path python_program();

/// The files of that folder with this extension, by their names without it; none if it is missing.
std::map<std::string, std::filesystem::path> data_files(const std::filesystem::path& what,
                                                        const std::string& extension);

}  // namespace clca::process
