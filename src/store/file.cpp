#include "clca/store/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "store/descriptor.hpp"

namespace clca::store {

namespace {

bool write_and_rename(const std::filesystem::path& aside, const std::filesystem::path& path,
                      std::span<const std::uint8_t> bytes) {
  constexpr mode_t kReadableByAll = 0666;  // less what the umask takes away
  Descriptor file(::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll));
  return file.is_open() && write_all(file.number(), bytes) && ::fsync(file.number()) == 0 &&
         file.close() && ::rename(aside.c_str(), path.c_str()) == 0;
}

[[noreturn]] void fail(std::string_view what, const std::filesystem::path& path, int error) {
  throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), std::strerror(error)));
}

}  // namespace

void write_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  const std::filesystem::path aside = fmt::format("{}.part-{}", path.string(), ::getpid());
  if (!write_and_rename(aside, path, bytes)) {
    const int error = errno;
    ::unlink(aside.c_str());
    fail("write", path, error);
  }
}

void write_whole(const std::filesystem::path& path, std::string_view text) {
  write_whole(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::vector<std::uint8_t> read_whole(const std::filesystem::path& path, double most_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) {
    fail("read", path, errno);
  }
  std::vector<std::uint8_t> bytes;
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
