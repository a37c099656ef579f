#pragma once
// How much memory something takes, where the address sanitizer can tell.

#include <cstddef>

namespace clca::fuzz {

/// One at a time.
class MemoryMeter {
 public:
  /// From here on.
  MemoryMeter();
  /// Most bytes that were there at once, beyond those there at the begin; 0 without the sanitizer.
  static double max_bytes();
};

}  // namespace clca::fuzz
