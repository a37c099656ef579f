#include "clca/store/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "clca/store/file.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace {

int open_aside(const std::filesystem::path& aside) {
  constexpr mode_t kReadableByAll = 0666;  // less what the umask takes away
  return ::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll);
}

}  // namespace

WholeFile::WholeFile(std::filesystem::path path)
    : path_(std::move(path)),
      aside_(fmt::format("{}.part-{}", path_.string(), ::getpid())),
      file_(std::make_unique<Descriptor>(open_aside(aside_))) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path_, unknown)) {
    ::unlink(aside_.c_str());
    errno = EISDIR;
    fail();
  }
  if (!file_->is_open()) {
    fail();
  }
}

WholeFile::~WholeFile() {
  if (!aside_.empty()) {
    ::unlink(aside_.c_str());
  }
}

void WholeFile::fail() const {
  throw StoreError(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
}

void WholeFile::write(std::span<const std::uint8_t> bytes) {
  if (!write_all(file_->number(), bytes)) {
    fail();
  }
  size_ += bytes.size();
}

void WholeFile::write(std::string_view text) {
  write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void WholeFile::rewrite_begin(std::span<const std::uint8_t> bytes) {
  if (::lseek(file_->number(), 0, SEEK_SET) != 0 || !write_all(file_->number(), bytes) ||
      ::lseek(file_->number(), 0, SEEK_END) < 0) {
    fail();
  }
}

void WholeFile::finish() {
  if (::fsync(file_->number()) != 0 || !file_->close() ||
      ::rename(aside_.c_str(), path_.c_str()) != 0) {
    fail();
  }
  aside_.clear();
}

}  // namespace clca::store
