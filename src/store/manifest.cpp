#include "store/manifest.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <optional>

#include "clca/store/file.hpp"
#include "clca/text/name.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace {

constexpr const char* kManifest = ".clca.manifest";
constexpr std::string_view kHeader = "clca manifest 1\n";
constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

std::string line_of(std::string_view kind, std::string_view name) {
  return fmt::format("{} \"{}\"\n", kind, name);
}

/// The name in a line of this kind; none if it is another line or incomplete.
std::optional<std::string> name_in(std::string_view line, std::string_view kind) {
  const std::size_t before = kind.size() + 2;  // the kind, a blank and a quote
  if (line.size() <= before || !line.starts_with(kind) || line.substr(kind.size(), 2) != " \"" ||
      line.back() != '"') {
    return std::nullopt;
  }
  return std::string(line.substr(before, line.size() - before - 1));
}

/// Reads at most `count` bytes of a file.
std::string read_text(int file, std::size_t most) {
  struct stat status {};
  if (::fstat(file, &status) == 0) {
    most = std::min(most, static_cast<std::size_t>(status.st_size));
  }
  std::string text(most, '\0');
  std::size_t size = 0;
  ssize_t count = 0;
  while (size < most &&
         (count = ::pread(file, text.data() + size, most - size, static_cast<off_t>(size))) > 0) {
    size += static_cast<std::size_t>(count);
  }
  text.resize(size);
  return text;
}

/// Whether a text starts like a manifest; the last word of the header may be missing.
bool is_header(const std::string& text) {
  return kHeader.starts_with(std::string_view(text).substr(0, kHeader.size()));
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

/// The open manifest, locked against changes by other processes.
class ManifestFile::Locked {
 public:
  explicit Locked(const ManifestFile& manifest) : manifest_(manifest) {
    constexpr int kFlags = O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    struct stat held {};
    do {
      file_ = Descriptor(::openat(manifest.folder_, kManifest, kFlags, kReadableByAll));
      if (!file_.is_open() || !lock() || ::fstat(file_.number(), &held) != 0) {
        fail();
      }
      if (!S_ISREG(held.st_mode)) {
        manifest_.refuse("write", "it is not a regular file");
      }
      if (!is_header(read_text(file_.number(), kHeader.size()))) {
        manifest_.refuse("write", "it is not a clca manifest");
      }
      if (held.st_nlink > 1) {  // of a backup, which is not to be changed
        manifest_.put(read_text(file_.number(), kMaxBytes));
      }
    } while (!is_in_place(held));
    size_ = held.st_size;
    if (size_ == 0 && manifest.expected_) {
      manifest_.refuse("write", "it has been removed or emptied meanwhile");
    }
  }

  void append(std::string text, Sync sync) {
    char last = '\n';
    if (size_ < static_cast<off_t>(kHeader.size())) {
      text = std::string(kHeader) + text;
      if (::ftruncate(file_.number(), 0) != 0) {  // a header that was not written whole
        fail();
      }
    } else if (::pread(file_.number(), &last, 1, size_ - 1) == 1 && last != '\n') {
      text = '\n' + text;  // the line before was not written whole
    }
    const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    if (!write_all(file_.number(), bytes) ||
        (sync == Sync::yes && ::fdatasync(file_.number()) != 0)) {
      const int error = errno;
      [[maybe_unused]] const int undone = ::ftruncate(file_.number(), size_);
      errno = error;
      fail();
    }
  }

 private:
  /// Waits a few seconds for other processes, which hold the lock only briefly.
  bool lock() const {
    constexpr int kTries = 500;
    constexpr useconds_t kPause = 10'000;
    for (int i = 0; i < kTries; ++i) {
      if (::flock(file_.number(), LOCK_EX | LOCK_NB) == 0) {
        return true;
      }
      if (errno != EWOULDBLOCK && errno != EINTR) {
        return false;
      }
      ::usleep(kPause);
    }
    return false;
  }
  /// Whether no other process replaced the manifest before this one locked it.
  bool is_in_place(const struct stat& held) const {
    struct stat named {};
    return ::fstatat(manifest_.folder_, kManifest, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           held.st_ino == named.st_ino && held.st_dev == named.st_dev;
  }
  [[noreturn]] void fail() const { manifest_.refuse("write", std::strerror(errno)); }

  const ManifestFile& manifest_;
  Descriptor file_;
  off_t size_ = 0;
};

void ManifestFile::refuse(std::string_view what, const char* reason) const {
  throw StoreError(fmt::format("cannot {} {}: {}", what, (path_ / kManifest).string(), reason));
}

Manifest ManifestFile::read() const {
  const Descriptor file(
      ::openat(folder_, kManifest, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file.is_open() && errno == ENOENT) {
    return {};
  }
  if (!file.is_open()) {
    refuse("read", std::strerror(errno));
  }
  if (!file.is_regular() || ::lseek(file.number(), 0, SEEK_END) > static_cast<off_t>(kMaxBytes)) {
    refuse("read", "it is not a clca manifest");
  }
  const std::string text = read_text(file.number(), kMaxBytes);
  if (!is_header(text)) {
    refuse("read", "it is not a clca manifest");
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
    } else if (const auto removed = name_in(line, "removed")) {
      manifest.files.erase(*removed);
    } else if (auto folder = name_in(line, "folder")) {
      manifest.folders.insert(*std::move(folder));
    } else if (auto mark = name_in(line, "temporary")) {
      manifest.temporary.insert(*std::move(mark));
    }
  }
  for (const auto* names : {&manifest.files, &manifest.folders}) {
    if (!std::all_of(names->begin(), names->end(), is_inside)) {
      refuse("read", "it names files outside of the folder");
    }
  }
  return manifest;
}

void ManifestFile::append(std::string_view kind, const std::set<std::string>& names,
                          Sync sync) const {
  std::string lines;
  for (const std::string& name : names) {
    lines += line_of(kind, name);
  }
  Locked(*this).append(lines, sync);
}

void ManifestFile::put(std::string_view text) const {
  const std::string temporary = std::string(kManifest) + "-new";
  ::unlinkat(folder_, temporary.c_str(), 0);  // of a process that was killed: all hold the lock
  const Descriptor file(::openat(folder_, temporary.c_str(),
                                 O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                                 kReadableByAll));
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!file.is_open() || !write_all(file.number(), bytes) || ::fsync(file.number()) != 0 ||
      ::renameat(folder_, temporary.c_str(), folder_, kManifest) != 0) {
    const int error = errno;
    ::unlinkat(folder_, temporary.c_str(), 0);
    refuse("write", std::strerror(error));
  }
}

void ManifestFile::replace(const Manifest& seen, Manifest left) const {
  const Locked locked(*this);
  const Manifest now = read();
  std::string text(kHeader);
  const auto add = [&](std::string_view kind, std::set<std::string> Manifest::*names) {
    std::set_difference((now.*names).begin(), (now.*names).end(), (seen.*names).begin(),
                        (seen.*names).end(), std::inserter(left.*names, (left.*names).end()));
    for (const std::string& name : left.*names) {
      text += line_of(kind, name);
    }
  };
  add("file", &Manifest::files);
  add("folder", &Manifest::folders);
  add("temporary", &Manifest::temporary);
  put(text);
}

void ManifestFile::remove_if_empty() const {
  if (::faccessat(folder_, kManifest, F_OK, AT_SYMLINK_NOFOLLOW) != 0) {
    return;
  }
  const Locked locked(*this);
  const Manifest manifest = read();
  if (manifest.files.empty() && manifest.folders.empty()) {
    ::unlinkat(folder_, kManifest, 0);
  }
}

}  // namespace clca::store
