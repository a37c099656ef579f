#include "store/manifest.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "clca/store/file.hpp"
#include "clca/text/name.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace {

constexpr const char* kManifest = ".clca.manifest";
constexpr std::string_view kHeader = "clca manifest 1\n";

std::string line_of(std::string_view kind, std::string_view name) {
  return fmt::format("{} \"{}\"\n", kind, name);
}

/// The name in a line of that kind; nothing where it is no such line, or was not written whole.
std::optional<std::string> name_in(std::string_view line, std::string_view kind) {
  const std::size_t before = kind.size() + 2;  // the kind, a blank and a quote
  if (line.size() <= before || !line.starts_with(kind) || line.substr(kind.size(), 2) != " \"" ||
      line.back() != '"') {
    return std::nullopt;
  }
  return std::string(line.substr(before, line.size() - before - 1));
}

std::string read_text(int file) {
  std::string text;
  std::vector<char> block(1U << 16U);
  for (off_t at = 0;; at = static_cast<off_t>(text.size())) {
    const ssize_t count = ::pread(file, block.data(), block.size(), at);
    if (count <= 0) {
      return text;
    }
    text.append(block.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

bool is_inside(std::string_view name) {
  for (std::size_t start = 0; start <= name.size();) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    if (!text::is_file_name(name.substr(start, end - start))) {
      return false;
    }
    start = end + 1;
  }
  return true;
}

/// The manifest, open and locked against other processes that change it.
class ManifestFile::Locked {
 public:
  explicit Locked(const ManifestFile& manifest) : path_(manifest.path_) {
    constexpr int kFlags = O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    struct stat held {};
    struct stat named {};
    do {  // another process may have put a new one in place before the lock was had
      file_ = Descriptor(::openat(manifest.folder_, kManifest, kFlags, kReadableByAll));
      if (!file_.is_open() || ::flock(file_.number(), LOCK_EX) != 0 ||
          ::fstat(file_.number(), &held) != 0) {
        fail();
      }
    } while (::fstatat(manifest.folder_, kManifest, &named, AT_SYMLINK_NOFOLLOW) != 0 ||
             held.st_ino != named.st_ino || held.st_dev != named.st_dev);
    if (!S_ISREG(held.st_mode)) {
      errno = EINVAL;
      fail();
    }
    size_ = held.st_size;
  }

  void append(std::string text) {
    char last = '\n';
    if (size_ == 0) {
      text = std::string(kHeader) + text;
    } else if (::pread(file_.number(), &last, 1, size_ - 1) == 1 && last != '\n') {
      text = '\n' + text;  // the line before was not written whole
    }
    const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    if (!write_all(file_.number(), bytes) || ::fdatasync(file_.number()) != 0) {
      const int error = errno;
      [[maybe_unused]] const int undone = ::ftruncate(file_.number(), size_);
      errno = error;
      fail();
    }
  }

 private:
  [[noreturn]] void fail() const {
    throw StoreError(
        fmt::format("cannot write {}: {}", (path_ / kManifest).string(), std::strerror(errno)));
  }

  std::filesystem::path path_;
  Descriptor file_;
  off_t size_ = 0;
};

Manifest ManifestFile::read() const {
  const auto refuse = [&](std::string_view reason) {
    throw StoreError(fmt::format("cannot read {}: {}", (path_ / kManifest).string(), reason));
  };
  const Descriptor file(
      ::openat(folder_, kManifest, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file.is_open()) {
    if (errno != ENOENT) {
      refuse(std::strerror(errno));
    }
    return {};
  }
  const std::string text = file.is_regular() ? read_text(file.number()) : "";
  if (!kHeader.starts_with(text.substr(0, kHeader.size())) || !file.is_regular()) {
    refuse("it is no manifest of clca");
  }
  Manifest manifest;
  for (std::size_t start = kHeader.size(); start < text.size();) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string::npos) {
      break;  // not written whole
    }
    const std::string_view line = std::string_view(text).substr(start, end - start);
    start = end + 1;
    if (auto name = name_in(line, "file")) {
      manifest.files.insert(*std::move(name));
    } else if (auto folder = name_in(line, "folder")) {
      manifest.folders.insert(*std::move(folder));
    } else if (auto mark = name_in(line, "temporary")) {
      manifest.temporary.insert(*std::move(mark));
    }
  }
  for (const auto* names : {&manifest.files, &manifest.folders}) {
    if (!std::all_of(names->begin(), names->end(), is_inside)) {
      refuse("it names files outside of the folder");
    }
  }
  return manifest;
}

void ManifestFile::append(std::string_view kind, const std::string& name) const {
  Locked(*this).append(line_of(kind, name));
}

void ManifestFile::replace(const Manifest& manifest, const std::string& temporary) const {
  std::string text(kHeader);
  for (const std::string& name : manifest.files) {
    text += line_of("file", name);
  }
  for (const std::string& name : manifest.folders) {
    text += line_of("folder", name);
  }
  for (const std::string& mark : manifest.temporary) {
    text += line_of("temporary", mark);
  }
  const Locked locked(*this);
  Descriptor file(::openat(folder_, temporary.c_str(),
                           O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kReadableByAll));
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!file.is_open() || !write_all(file.number(), bytes) || ::fsync(file.number()) != 0 ||
      ::renameat(folder_, temporary.c_str(), folder_, kManifest) != 0) {
    const int error = errno;
    ::unlinkat(folder_, temporary.c_str(), 0);
    throw StoreError(
        fmt::format("cannot write {}: {}", (path_ / kManifest).string(), std::strerror(error)));
  }
}

void ManifestFile::remove_if_only(const std::string& mark) const {
  if (read().temporary.empty()) {
    return;  // another output folder of this process was the last
  }
  const Locked locked(*this);
  const Manifest manifest = read();
  if (manifest.files.empty() && manifest.folders.empty() &&
      manifest.temporary == std::set<std::string>{mark}) {
    ::unlinkat(folder_, kManifest, 0);
  }
}

}  // namespace clca::store
