#pragma once
// Text files that grow while a run goes on.

#include <cstdint>
#include <string>
#include <string_view>

#include "clca/store/output_folder.hpp"

namespace clca::store {

/// A file that text is added to. What a run had added after its last checkpoint is cut off when it
/// goes on from there.
class GrowingFile {
 public:
  /// Keeps the first `kept` bytes of the file. Made only when something is added. Throws StoreError
  /// for a file that has less.
  GrowingFile(OutputFolder folder, std::string name, std::uint64_t kept);

  /// Throws StoreError.
  void append(std::string_view text);
  /// Has it on the disk, if it is there. May be called while another thread appends. Throws
  /// StoreError.
  void sync() const { folder_.sync(name_); }
  std::uint64_t bytes() const { return bytes_; }

 private:
  OutputFolder folder_;
  std::string name_;
  std::uint64_t bytes_;
};

}  // namespace clca::store
