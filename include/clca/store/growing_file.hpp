#pragma once
// Text files that grow during a run.

#include <cstdint>
#include <string>
#include <string_view>

#include "clca/store/output_folder.hpp"

namespace clca::store {

/// A file that text is appended to. When a run resumes, text written after its checkpoint is cut
/// off.
class GrowingFile {
 public:
  /// Keeps the first `kept` bytes of the file, which is made with the first append. Throws
  /// StoreError if it has fewer.
  GrowingFile(OutputFolder folder, std::string name, std::uint64_t kept);

  /// Is on the disk after OutputFolder::flush(). Throws StoreError.
  void append(std::string_view text);
  std::uint64_t bytes() const { return bytes_; }

 private:
  OutputFolder folder_;
  std::string name_;
  std::uint64_t bytes_;
};

}  // namespace clca::store
