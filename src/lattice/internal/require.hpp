#pragma once
// Preconditions.

#include <stdexcept>

namespace clca {

/// Throws std::invalid_argument unless it holds.
inline void require(bool holds, const char* reason) {
  if (!holds) {
    throw std::invalid_argument(reason);
  }
}

}  // namespace clca
