#include "clca/text/read.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace clca::text {

namespace {

class OpenFile {
 public:
  /// Does not block on a pipe.
  explicit OpenFile(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    if (number_ < 0) {
      fail();
    }
  }
  ~OpenFile() { ::close(number_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  struct stat status() const {
    struct stat status {};
    if (::fstat(number_, &status) != 0) {
      fail();
    }
    return status;
  }

  /// 0 at the end.
  std::size_t read(std::vector<std::uint8_t>& block) const {
    while (true) {
      const ssize_t count = ::read(number_, block.data(), block.size());
      if (count >= 0) {
        return static_cast<std::size_t>(count);
      }
      if (errno != EINTR) {
        fail();
      }
    }
  }

 private:
  [[noreturn]] static void fail() { throw ReadError(std::strerror(errno)); }

  int number_;
};

[[noreturn]] void refuse_size(double max_bytes) {
  constexpr double kMebibyte = 1 << 20;
  throw ReadError(fmt::format("it is larger than the limit of {:.4g} MiB", max_bytes / kMebibyte));
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::filesystem::path& file, double max_bytes) {
  const OpenFile open(file);
  const struct stat status = open.status();
  if (!S_ISREG(status.st_mode)) {
    throw ReadError(S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file");
  }
  if (static_cast<double>(status.st_size) > max_bytes) {
    refuse_size(max_bytes);
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size));  // growing would take twice as much
  std::vector<std::uint8_t> block(1U << 16U);
  while (const std::size_t count = open.read(block)) {
    if (static_cast<double>(bytes.size()) + static_cast<double>(count) > max_bytes) {
      refuse_size(max_bytes);
    }
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return bytes;
}

bool is_file_name(std::string_view text) {
  constexpr std::size_t kMaxLength = 200;
  return !text.empty() && text.size() <= kMaxLength && text.front() != '.' &&
         std::ranges::none_of(text, [](char letter) {
           const auto code = static_cast<unsigned char>(letter);
           return letter == '/' || code < 0x20 || code == 0x7F;
         });
}

}  // namespace clca::text
