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
#include "clca/text/read.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace {

constexpr const char* kManifest = ".clca.manifest";
constexpr const char* kManifestNew = ".clca.manifest-new";  // replaces it
constexpr int kManifestTries = 500;                         // for a few seconds
constexpr useconds_t kManifestPause = 10'000;
constexpr int kManifestFlags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
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

/// Reads at most `most` bytes of a file, to its end: over a network, the size it is said to have
/// may be an old one. None on failure.
std::optional<std::string> read_text(int file, std::size_t most) {
  constexpr std::size_t kBlock = 1U << 16U;
  std::string text;
  for (;;) {
    const std::size_t size = text.size();
    text.resize(std::min(most, size + kBlock));
    const ssize_t count =
        ::pread(file, text.data() + size, text.size() - size, static_cast<off_t>(size));
    text.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count <= 0) {
      return count == 0 ? std::optional(std::move(text)) : std::nullopt;
    }
  }
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
    for (int tries = 0; !open_in_place(); ++tries) {
      if (tries == kManifestTries) {
        errno = ESTALE;
        fail();
      }
      ::usleep(kManifestPause);
    }
    if (size_ == 0 && manifest.expected_) {
      manifest_.refuse("write", "it has been removed or emptied meanwhile");
    }
  }

  void append(std::string text, Sync sync) {
    char last = '\n';
    if (size_ < static_cast<off_t>(kHeader.size())) {
      text = std::string(kHeader) + text;
      if (size_ > 0 && ::ftruncate(file_.number(), 0) != 0) {  // a header not written whole
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

  /// Undoes append().
  void withdraw() {
    if (::ftruncate(file_.number(), size_) != 0 || ::fdatasync(file_.number()) != 0) {
      fail();
    }
  }

 private:
  /// Opens and locks the manifest. False if another process has replaced it meanwhile.
  bool open_in_place() {
    file_ = manifest_.open(O_RDWR | O_APPEND);
    if (!file_.is_open() && errno == ENOENT) {
      file_ = Descriptor(::openat(manifest_.folder_, kManifest,
                                  O_RDWR | O_APPEND | O_CREAT | kManifestFlags, kReadableByAll));
    }
    struct stat held {};
    if (!file_.is_open() || !lock() || ::fstat(file_.number(), &held) != 0) {
      return is_stale();
    }
    if (!S_ISREG(held.st_mode)) {
      manifest_.refuse("write", "it is not a regular file");
    }
    const auto header = read_text(file_.number(), kHeader.size());
    if (!header) {
      return is_stale();
    }
    if (!is_header(*header)) {
      manifest_.refuse("write", "it is not a clca manifest");
    }
    if (held.st_nlink > 1) {  // of a backup, which is not to be changed
      const auto text = read_text(file_.number(), kMaxBytes);
      if (!text) {
        return is_stale();
      }
      manifest_.put(*text);
    }
    size_ = held.st_size;
    return is_in_place(held);
  }
  /// False if the open file is none any more on another machine; throws for other errors.
  bool is_stale() const {
    if (errno != ESTALE) {
      fail();
    }
    return false;
  }
  /// Waits for other processes, which hold the lock only briefly.
  bool lock() const {
    for (int i = 0; i < kManifestTries; ++i) {
      if (::flock(file_.number(), LOCK_EX | LOCK_NB) == 0) {
        return true;
      }
      if (errno != EWOULDBLOCK && errno != EINTR) {
        return false;
      }
      ::usleep(kManifestPause);
    }
    return false;
  }
  /// Whether no other process replaced the manifest before this one locked it.
  bool is_in_place(const struct stat& held) const {
    struct stat named {};
    const Descriptor folder = opened_anew(manifest_.folder_);
    return ::fstatat(folder.number(), kManifest, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
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

Descriptor ManifestFile::open(int flags) const {
  constexpr int kMost = 50;
  bool once_more = true;
  for (int tries = 0;; ++tries) {
    const Descriptor folder = opened_anew(folder_);
    if (!folder.is_open()) {
      return Descriptor();
    }
    Descriptor file(::openat(folder.number(), kManifest, flags | kManifestFlags));
    if (file.is_open() || errno != ENOENT || tries == kMost) {
      return file;
    }
    // NFS replaces an open file in two steps, and other machines see none between them.
    const bool is_between =
        ::faccessat(folder.number(), kManifestNew, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
    if (!is_between && !once_more) {
      errno = ENOENT;
      return file;
    }
    if (is_between) {
      ::usleep(kManifestPause);
    }
    once_more = is_between;
  }
}

std::string ManifestFile::text() const {
  for (int tries = 0;; ++tries) {
    const Descriptor file = open(O_RDONLY);
    if (!file.is_open() && errno == ENOENT) {
      return "";
    }
    struct stat status {};
    std::optional<std::string> text;
    if (file.is_open() && ::fstat(file.number(), &status) == 0) {
      if (!S_ISREG(status.st_mode) || status.st_size > static_cast<off_t>(kMaxBytes)) {
        refuse("read", "it is not a clca manifest");
      }
      text = read_text(file.number(), kMaxBytes);
    }
    if (text) {
      return *std::move(text);
    }
    if (errno != ESTALE || tries == kManifestTries) {  // ESTALE: replaced meanwhile
      refuse("read", std::strerror(errno));
    }
    ::usleep(kManifestPause);
  }
}

Manifest ManifestFile::read() const {
  const std::string text = this->text();
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

bool ManifestFile::add_file(const std::string& name, const GiveName& give) const {
  Locked locked(*this);
  locked.append(line_of("file", name), Sync::yes);
  if (give(false)) {
    return true;
  }
  if (errno != EEXIST) {
    return false;
  }
  locked.withdraw();
  if (read().files.contains(name)) {
    return give(true);
  }
  errno = EEXIST;
  return false;
}

bool ManifestFile::replace_file(const std::string& name, const GiveName& give) const {
  {
    const Locked locked(*this);
    if (read().files.contains(name)) {
      return give(true);
    }
  }
  return add_file(name, give);
}

void ManifestFile::remove_file(const std::string& name, const std::function<void()>& remove) const {
  Locked locked(*this);
  remove();
  locked.append(line_of("removed", name), Sync::yes);
}

void ManifestFile::put(std::string_view text) const {
  ::unlinkat(folder_, kManifestNew, 0);  // of a process that was killed: all hold the lock
  const Descriptor file(::openat(
      folder_, kManifestNew, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kReadableByAll));
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!file.is_open() || !write_all(file.number(), bytes) || ::fsync(file.number()) != 0 ||
      ::renameat(folder_, kManifestNew, folder_, kManifest) != 0) {
    const int error = errno;
    ::unlinkat(folder_, kManifestNew, 0);
    refuse("write", std::strerror(error));
  }
}

void ManifestFile::replace(const Manifest& seen, Manifest left,
                           const std::function<bool(const std::string& name)>& is_there) const {
  const Locked locked(*this);
  const Manifest now = read();
  std::string text(kHeader);
  const auto add = [&](std::string_view kind, std::set<std::string> Manifest::*names) {
    std::copy_if(
        (now.*names).begin(), (now.*names).end(), std::inserter(left.*names, (left.*names).end()),
        [&](const std::string& name) { return !(seen.*names).contains(name) || is_there(name); });
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
