#pragma once
// The file layer of GSD, version 2.0 (gsd.readthedocs.io, "File layer"): a header, then named
// chunks of numbers frame by frame, then a list of their names and an index.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "clca/store/atomic_file.hpp"
#include "export/bytes.hpp"

namespace clca::exports {

/// Numbers of the types that are used, as the layout has them.
enum class GsdType : std::uint8_t {
  uint8 = 1,
  uint32 = 3,
  uint64 = 4,
  int8 = 5,
  int32 = 7,
  float32 = 9
};

/// An array of `rows` rows of `columns` numbers.
struct GsdChunk {
  std::uint16_t name = 0;  ///< index into the names
  GsdType type = GsdType::uint8;
  std::uint64_t rows = 0;
  std::uint32_t columns = 1;
};

class GsdFile {
 public:
  /// All names that chunks will have. The schema is "hoomd" 1.4.
  GsdFile(store::AtomicFile file, std::vector<std::string> names);

  /// Within a frame names must ascend.
  void write(const GsdChunk& chunk, std::span<const std::uint8_t> numbers);
  void end_frame() { ++frame_; }
  /// Writes names, index and header.
  void finish();

 private:
  struct Entry {
    std::uint64_t frame = 0;
    std::uint64_t rows = 0;
    std::int64_t location = 0;
    std::uint32_t columns = 0;
    std::uint16_t name = 0;
    GsdType type = GsdType::uint8;
    std::uint8_t flags = 0;
  };
  static_assert(sizeof(Entry) == 32);

  store::AtomicFile file_;
  std::vector<std::string> names_;
  std::uint64_t frame_ = 0;
  std::vector<Entry> index_;
};

}  // namespace clca::exports
