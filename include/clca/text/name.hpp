#pragma once
// Safe file names.

#include <string_view>

namespace clca::text {

/// Whether `text` is safe as a file name, or its beginning: a single path component, no leading
/// dot, no control characters, at most 200 bytes.
bool is_file_name(std::string_view text);

}  // namespace clca::text
