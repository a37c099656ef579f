#include "clca/store/growing_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "clca/store/file.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace {

constexpr mode_t kModeOfAll = 0666;  // less what the umask takes away

[[noreturn]] void fail_growing(const std::filesystem::path& path, int error) {
  throw StoreError(fmt::format("cannot write {}: {}", path.string(), std::strerror(error)));
}

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path path, std::uint64_t kept)
    : path_(std::move(path)), bytes_(kept) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path_, error);
  if (kept > 0 && (error || size < kept)) {
    throw StoreError(
        fmt::format("cannot go on with {}: it is shorter than when the checkpoint was "
                    "made",
                    path_.string()));
  }
  if (!error && size > kept) {
    if (kept == 0) {
      std::filesystem::remove(path_, error);
    } else {
      std::filesystem::resize_file(path_, kept, error);
    }
    if (error) {
      fail_growing(path_, error.value());
    }
  }
}

void GrowingFile::append(std::string_view text) {
  if (text.empty()) {
    return;
  }
  Descriptor file(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, kModeOfAll));
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!file.is_open() || !write_all(file.number(), bytes) || !file.close()) {
    fail_growing(path_, errno);
  }
  bytes_ += text.size();
}

void GrowingFile::sync() const {
  const Descriptor file(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open() && errno == ENOENT) {
    return;
  }
  if (!file.is_open() || ::fsync(file.number()) != 0) {
    fail_growing(path_, errno);
  }
}

}  // namespace clca::store
