#pragma once
// Text that describes something in YAML, and what is wrong in it.

#include <cstddef>
#include <stdexcept>
#include <string>

namespace clca::document {

/// Maximum size of the text. The parser may need 250 times that in memory.
inline constexpr std::size_t kMaxBytes = std::size_t{4} << 20U;

/// An error in the text. what() is one line: `FILE:LINE:COLUMN: error: MESSAGE`.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The text of a value as one that is the same for all texts that mean the same: `0.5` of 0.50 and
/// =1/2. What is no YAML, or depends on names under `let`, stays as it is.
std::string canonical_value(const std::string& text);

}  // namespace clca::document
