#pragma once
// Memory held back, so that a run that runs out of memory can still write its summary.

#include <cstddef>
#include <vector>

namespace clca::run {

class MemoryReserve {
 public:
  /// Frees it.
  void reset() { std::vector<std::byte>().swap(bytes_); }

 private:
  static constexpr std::size_t kBytes = std::size_t{1} << 20U;

  std::vector<std::byte> bytes_ = std::vector<std::byte>(kBytes);
};

}  // namespace clca::run
