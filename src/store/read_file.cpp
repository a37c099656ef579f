#include <fmt/format.h>

#include "clca/store/file.hpp"
#include "clca/text/read.hpp"

namespace clca::store {

std::vector<std::uint8_t> read_whole(const std::filesystem::path& path, double max_bytes) {
  try {
    return text::read_file(path, max_bytes);
  } catch (const text::ReadError& error) {
    throw StoreError(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

}  // namespace clca::store
