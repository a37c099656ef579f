#pragma once
// A file in memory, for readers that want a path.

#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <span>
#include <string>

#include "target.hpp"

namespace clca::fuzz {

class ScratchFile {
 public:
  ScratchFile() : number_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    require(number_ >= 0, "no file in memory");
  }
  ~ScratchFile() { ::close(number_); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(number_); }

  /// Holds these bytes and no more from now on.
  void hold(std::span<const std::uint8_t> bytes) const {
    const bool held =
        ::ftruncate(number_, 0) == 0 &&
        ::pwrite(number_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
    require(held, "cannot write to a file in memory");
  }
  void hold(std::string_view text) const {
    hold({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

 private:
  int number_;
};

}  // namespace clca::fuzz
