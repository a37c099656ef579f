// Any bytes behind a right checksum header, read as a checkpoint: refused, or the same once written
// and read again, and within the limit of memory.

#include <optional>
#include <stdexcept>

#include "clca/store/checkpoint.hpp"
#include "memory_meter.hpp"
#include "store/checksum_header.hpp"
#include "target.hpp"

namespace {

using namespace clca;

constexpr store::FileKind kKind = {"checkpoint", 2};
constexpr double kLimit = 1e6;
constexpr double kBeside = 1e5;  // zlib, a block of bytes

std::optional<store::Checkpoint> read(const std::vector<std::uint8_t>& file, double limit) {
  const fuzz::MemoryMeter meter;
  try {
    store::Checkpoint checkpoint = store::parse_checkpoint(file, limit);
    fuzz::require(meter.max_bytes() <= limit + kBeside, "more memory than the limit");
    return checkpoint;
  } catch (const std::runtime_error&) {
    fuzz::require(meter.max_bytes() <= limit + kBeside, "more memory than the limit");
    return std::nullopt;
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = store::with_header(kKind, {data, size});
  const auto checkpoint = read(file, kLimit);
  if (checkpoint) {
    const auto again = store::checkpoint_bytes(*checkpoint);
    const auto read_again = read(again, 10 * kLimit);
    fuzz::require(read_again && store::checkpoint_bytes(*read_again) == again,
                  "read again as something else");
  }
  return 0;
}
