#pragma once
// Which text may name a file.

#include <string_view>

namespace clca::text {

/// Whether `text` can safely be a file or folder's own name, or the beginning of one, whoever wrote
/// it: one component of a path, not hidden (no dot in front), without control characters, at most
/// 200 bytes, so that endings fit behind it.
bool is_file_name(std::string_view text);

}  // namespace clca::text
