#pragma once
// Memory kept back, so that a run which finds none left can still say so in its folder.

#include <cstddef>
#include <memory>

namespace clca::run {

class Reserve {
 public:
  /// Gives it back.
  void reset() { bytes_.reset(); }

 private:
  static constexpr std::size_t kBytes = std::size_t{1} << 20U;

  std::unique_ptr<std::byte[]> bytes_ = std::make_unique_for_overwrite<std::byte[]>(kBytes);
};

}  // namespace clca::run
