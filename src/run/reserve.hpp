#pragma once
// Memory kept back, so that a run which finds none left can still say so in its folder.

#include <cstddef>
#include <vector>

namespace clca::run {

class Reserve {
 public:
  /// Gives it back.
  void reset() { std::vector<std::byte>().swap(bytes_); }

 private:
  static constexpr std::size_t kBytes = std::size_t{1} << 20U;

  std::vector<std::byte> bytes_ = std::vector<std::byte>(kBytes);
};

}  // namespace clca::run
