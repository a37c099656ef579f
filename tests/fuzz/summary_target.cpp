// A run.json: refused, or the same once written and read again.

#include <optional>
#include <string>

#include "clca/store/file.hpp"
#include "clca/store/summary.hpp"
#include "scratch_file.hpp"

namespace {

namespace fuzz = clca::fuzz;
namespace store = clca::store;

std::optional<std::string> read_and_written(const fuzz::ScratchFile& file) {
  try {
    return store::to_json(store::read_summary(file.path()));
  } catch (const store::StoreError&) {
    return std::nullopt;
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file;
  file.hold({data, size});
  if (const auto once = read_and_written(file)) {
    file.hold(*once);
    fuzz::require(read_and_written(file) == once, "another summary");
  }
  return 0;
}
