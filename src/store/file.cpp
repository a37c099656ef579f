#include "clca/store/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "clca/store/output_folder.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace {

[[noreturn]] void fail(std::string_view what, const std::filesystem::path& path, int error) {
  throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), std::strerror(error)));
}

}  // namespace

void write_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  AtomicFile file = named_file(path).create();
  file.write(bytes);
  file.finish();
}

void write_whole(const std::filesystem::path& path, std::string_view text) {
  write_whole(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    fail("make the folder", folder, error.value());
  }
}

std::vector<std::uint8_t> read_whole(const std::filesystem::path& path, double most_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) {
    fail("read", path, errno);
  }
  std::vector<std::uint8_t> bytes;
  if (const auto size = static_cast<double>(status.st_size); size > 0 && size <= most_bytes) {
    bytes.reserve(static_cast<std::size_t>(status.st_size));  // growing would take twice as much
  }
  std::vector<std::uint8_t> block(1U << 16U);
  while (true) {
    const ssize_t count = ::read(file.number(), block.data(), block.size());
    if (count < 0) {
      if (errno == EINTR) {
        continue;
      }
      fail("read", path, errno);
    }
    if (count == 0) {
      return bytes;
    }
    if (static_cast<double>(bytes.size()) + static_cast<double>(count) > most_bytes) {
      throw StoreError(
          fmt::format("cannot read {}: it needs more memory than the limit", path.string()));
    }
    bytes.insert(bytes.end(), block.begin(), block.begin() + count);
  }
}

}  // namespace clca::store
