#include "clca/text/read.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace clca::text {

namespace {

[[noreturn]] void fail() {
  throw ReadError(std::strerror(errno));
}

[[noreturn]] void refuse_size(double max_bytes) {
  constexpr double kMebibyte = 1 << 20;
  throw ReadError(fmt::format("it is larger than the limit of {:.4g} MiB", max_bytes / kMebibyte));
}

}  // namespace

std::vector<std::uint8_t> read_file(const std::filesystem::path& file, double max_bytes) {
  // Does not block on a pipe.
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (number < 0) {
    fail();
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(::fdopen(number, "rb"),
                                                               &std::fclose);
  struct stat status {};
  if (stream == nullptr || ::fstat(number, &status) != 0) {
    fail();
  }
  if (!S_ISREG(status.st_mode)) {
    throw ReadError(S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file");
  }
  if (static_cast<double>(status.st_size) > max_bytes) {
    refuse_size(max_bytes);
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(static_cast<std::size_t>(status.st_size));  // growing would take twice as much
  std::vector<std::uint8_t> block(1U << 16U);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), stream.get())) {
    if (static_cast<double>(bytes.size()) + static_cast<double>(count) > max_bytes) {
      refuse_size(max_bytes);
    }
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
  }
  if (std::ferror(stream.get()) != 0) {
    fail();
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
