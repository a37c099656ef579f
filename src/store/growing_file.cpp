#include "clca/store/growing_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "clca/store/checkpoint.hpp"
#include "clca/store/file.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

GrowingFile::GrowingFile(OutputFolder folder, std::string name, std::uint64_t kept)
    : folder_(std::move(folder)), name_(std::move(name)), bytes_(kept) {
  if (kept == 0) {
    folder_.discard(name_);
  } else if (!folder_.truncate(name_, kept)) {
    throw UnusableCheckpointError(
        fmt::format("cannot go on with {}: it is shorter than when the checkpoint was made",
                    folder_.path(name_).string()));
  }
}

void GrowingFile::append(std::string_view text) {
  if (text.empty()) {
    return;
  }
  Descriptor file(folder_.open_to_append(name_));
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!write_all(file.number(), bytes) || !file.close()) {
    const int error = errno;
    folder_.truncate(name_, bytes_);  // no half line
    throw StoreError(
        fmt::format("cannot write {}: {}", folder_.path(name_).string(), std::strerror(error)));
  }
  bytes_ += text.size();
  folder_.flush_later(name_);
}

}  // namespace clca::store
