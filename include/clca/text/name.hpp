#pragma once
// Names that may become names of files.

#include <string_view>

namespace clca::text {

/// Whether `name` is one component of a path: not empty, not `.` or `..`, no `/`, no control
/// character and at most 200 bytes.
bool is_file_name(std::string_view name);

}  // namespace clca::text
