#include "clca/store/output_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iterator>
#include <mutex>
#include <random>
#include <tuple>
#include <utility>

#include "clca/store/file.hpp"
#include "store/atomic_file_state.hpp"
#include "store/manifest.hpp"

namespace clca::store {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporary = ".clca-";
constexpr int kFolderFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

[[noreturn]] void fail_at(const char* what, const fs::path& path, const char* reason) {
  throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), reason));
}

/// Part of the names of all temporary files of this process; practically unique.
const std::string& mark_of_process() {
  static const std::string kMark = [] {
    std::random_device device;
    return fmt::format("{:08x}{:08x}", device(), device());
  }();
  return kMark;
}

std::string temporary_name() {
  static std::atomic<std::uint64_t> count = 0;
  return fmt::format("{}{}-{}", kTemporary, mark_of_process(), ++count);
}

std::pair<std::string, std::string> folder_and_leaf(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? std::pair(std::string(), name)
                                    : std::pair(name.substr(0, slash), name.substr(slash + 1));
}

enum class Found : std::uint8_t { nothing, file, other };

Found found_in(int folder, const std::string& leaf) {
  struct stat status {};
  if (::fstatat(folder, leaf.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    return Found::nothing;
  }
  return S_ISREG(status.st_mode) ? Found::file : Found::other;
}

std::vector<std::string> names_in(int folder) {
  std::vector<std::string> names;
  const int copy = ::openat(folder, ".", kFolderFlags);
  DIR* stream = copy < 0 ? nullptr : ::fdopendir(copy);
  while (const dirent* entry = stream != nullptr ? ::readdir(stream) : nullptr) {
    names.emplace_back(entry->d_name);
  }
  if (stream != nullptr) {
    ::closedir(stream);
  } else if (copy >= 0) {
    ::close(copy);
  }
  return names;
}

bool is_temporary(const std::string& name) {
  return name.starts_with(kTemporary);
}

/// Removes a temporary file unless a process still uses it. NFS locks for writing only what is open
/// for writing.
void remove_if_abandoned(int folder, const std::string& name) {
  const Descriptor file(
      ::openat(folder, name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (file.is_open() && file.is_regular() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0) {
    ::unlinkat(folder, name.c_str(), 0);
  }
}

/// A new temporary file, locked, and its name. `path` is used in messages.
std::pair<Descriptor, std::string> locked_temporary_file(int folder, const fs::path& path) {
  constexpr int kMost = 20;
  for (int tries = 1;; ++tries) {
    std::string name = temporary_name();
    Descriptor file(::openat(folder, name.c_str(),
                             O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kReadableByAll));
    struct stat status {};
    const bool locked = file.is_open() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0 &&
                        ::fstat(file.number(), &status) == 0;
    if (locked && (status.st_nlink > 0 || tries == kMost)) {
      return {std::move(file), std::move(name)};
    }
    // Before it was locked, another process may have taken it for abandoned.
    if (!locked && (tries == kMost || (errno != EWOULDBLOCK && errno != ESTALE))) {
      fail_at("write", path, std::strerror(errno));
    }
  }
}

}  // namespace

/// The open folder and its manifest. Names are relative to the root folder.
class OutputFolder::State {
 public:
  /// `named`: for files named by the user, where the manifest is needed for temporary files only.
  /// In a shared folder (/tmp) the manifest may belong to another user; then none is used.
  State(fs::path path, bool named) : path_(std::move(path)), named_(named) {
    open();
    if (!folder_.is_open() && !named_ && errno != ENOENT) {
      fail_at("write to", path_, std::strerror(errno));
    }
    if (folder_.is_open()) {
      unless_named([this] { manifest_ = manifest_file().read(); });
    }
  }
  ~State() {
    if (!marked_) {
      return;
    }
    try {
      if (const std::set<std::string> unmade = only_planned(); !unmade.empty()) {
        manifest_file().remove_files(unmade);
      }
      const std::vector<std::string> names = names_in(folder_.number());
      if (std::none_of(names.begin(), names.end(), is_temporary)) {
        manifest_file().remove_if_empty();
      }
    } catch (const std::exception&) {  // it stays: that is harmless
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  const fs::path& path() const { return path_; }
  /// Throws if the folder of a file named by the user does not exist.
  void require_folder(const fs::path& file) {
    open();
    if (!folder_.is_open()) {
      fail_at("write", file, std::strerror(errno));
    }
  }
  ManifestFile manifest_file() const {
    return {folder_.number(), path_,
            !manifest_.files.empty() || !manifest_.folders.empty() || !planned_.empty()};
  }

  bool owns(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return manifest_.files.contains(name);
  }
  std::vector<std::string> files(const std::string& prefix);
  void require_free(const std::string& name);
  void plan(const std::set<std::string>& names);
  /// Lists a file before it gets its name, unless that was planned. Returns whether it is its own.
  bool claim(const std::string& name);
  /// Removes a file from the list.
  void disown(const std::string& name);
  /// The folder of the file `name`; not open if it does not exist or is reached only through a
  /// symbolic link.
  Descriptor parent(const std::string& name) const;
  /// The same, created if needed. Throws StoreError.
  Descriptor make_parent(const std::string& name);
  /// Lists the mark of this process before it makes its first temporary file.
  void mark();
  void remove(const std::string& name) const;
  void clear(const std::string& first, const std::string& kept);
  void delay_flushing() { delays_flushing_ = true; }
  bool delays_flushing() const { return delays_flushing_; }
  void flush_later(const std::string& name) {
    const std::lock_guard lock(mutex_);
    not_flushed_.insert(name);
  }
  void flush();
  /// Removes temporary files of killed processes.
  void remove_temporary_files() const;

 private:
  /// Ignores errors for files named by the user.
  template <class Act>
  void unless_named(Act act) {
    try {
      act();
    } catch (const StoreError&) {
      if (!named_) {
        throw;
      }
    }
  }
  void open() {
    const char* path = path_.empty() ? "." : path_.c_str();
    folder_ = Descriptor(::open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  }
  std::set<std::string> only_planned() const {
    std::set<std::string> names;
    std::set_difference(planned_.begin(), planned_.end(), manifest_.files.begin(),
                        manifest_.files.end(), std::inserter(names, names.end()));
    return names;
  }
  /// The manifest as it is, which another process may have changed, without what is only planned.
  Manifest read_manifest() const {
    Manifest manifest = manifest_file().read();
    for (const std::string& name : only_planned()) {
      manifest.files.erase(name);
    }
    return manifest;
  }

  fs::path path_;
  bool named_;
  std::atomic<bool> delays_flushing_ = false;
  std::mutex mutex_;  // of all below
  Descriptor folder_;
  Manifest manifest_;
  std::set<std::string> planned_;  // listed before they are written
  std::set<std::string> not_flushed_;
  bool marked_ = false;
};

std::vector<std::string> OutputFolder::State::files(const std::string& prefix) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> there;
  for (const std::string& name : manifest_.files) {
    const Descriptor folder = parent(name);
    if (name.starts_with(prefix) && folder.is_open() &&
        found_in(folder.number(), folder_and_leaf(name).second) == Found::file) {
      there.push_back(name.substr(prefix.size()));
    }
  }
  return there;
}

void OutputFolder::State::require_free(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const Descriptor folder = parent(name);
  const Found found =
      folder.is_open() ? found_in(folder.number(), folder_and_leaf(name).second) : Found::nothing;
  if (found == Found::other) {
    fail_at("write", path_ / name, "it is not a regular file");
  }
  if (found == Found::file && !manifest_.files.contains(name)) {
    manifest_.files.merge(read_manifest().files);
    if (!manifest_.files.contains(name)) {
      refuse_foreign(path_ / name);
    }
  }
}

void OutputFolder::State::plan(const std::set<std::string>& names) {
  make_parent("");
  mark();
  const std::lock_guard lock(mutex_);
  planned_ = names;
  if (const std::set<std::string> unlisted = only_planned(); !unlisted.empty()) {
    manifest_file().add_files(unlisted);
  }
}

bool OutputFolder::State::claim(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (manifest_.files.contains(name)) {
    return true;
  }
  if (!planned_.contains(name)) {
    manifest_file().add_files({name});
  }
  manifest_.files.insert(name);
  return false;
}

void OutputFolder::State::disown(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (manifest_.files.contains(name)) {
    manifest_file().remove_files({name});
    manifest_.files.erase(name);
    planned_.erase(name);
  }
}

Descriptor OutputFolder::State::parent(const std::string& name) const {
  Descriptor folder(folder_.is_open() ? ::openat(folder_.number(), ".", kFolderFlags) : -1);
  const std::string below = folder_and_leaf(name).first;
  for (std::size_t start = 0; start < below.size() && folder.is_open();) {
    const std::size_t end = std::min(below.find('/', start), below.size());
    folder = Descriptor(
        ::openat(folder.number(), below.substr(start, end - start).c_str(), kFolderFlags));
    start = end + 1;
  }
  return folder;
}

Descriptor OutputFolder::State::make_parent(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (!folder_.is_open()) {
    store::make_folder(path_);
    open();
    if (!folder_.is_open()) {
      fail_at("write to", path_, std::strerror(errno));
    }
  }
  Descriptor folder(::openat(folder_.number(), ".", kFolderFlags));
  const std::string below = folder_and_leaf(name).first;
  for (std::size_t start = 0; start < below.size() && folder.is_open();) {
    const std::size_t end = std::min(below.find('/', start), below.size());
    const std::string part = below.substr(start, end - start);
    if (::mkdirat(folder.number(), part.c_str(), 0777) == 0) {
      manifest_file().add_folder(below.substr(0, end));
      manifest_.folders.insert(below.substr(0, end));
    } else if (errno != EEXIST) {
      fail_at("make the folder", path_ / below.substr(0, end), std::strerror(errno));
    }
    folder = Descriptor(::openat(folder.number(), part.c_str(), kFolderFlags));
    if (!folder.is_open() && (errno == ELOOP || errno == ENOTDIR)) {
      fail_at("write to", path_ / below.substr(0, end),
              "it is no folder, or a symbolic link, which is not followed");
    }
    start = end + 1;
  }
  if (!folder.is_open()) {
    fail_at("write to", (path_ / name).parent_path(), std::strerror(errno));
  }
  return folder;
}

void OutputFolder::State::mark() {
  const std::lock_guard lock(mutex_);
  if (!marked_) {
    remove_temporary_files();
    unless_named([this] { manifest_file().add_temporary(mark_of_process()); });
    marked_ = true;
  }
}

void OutputFolder::State::remove(const std::string& name) const {
  const Descriptor folder = parent(name);
  if (!folder.is_open() && errno != ENOENT && errno != ENOTDIR && errno != ELOOP) {
    fail_at("remove", path_ / name, std::strerror(errno));
  }
  const std::string leaf = folder_and_leaf(name).second;
  if (folder.is_open() && found_in(folder.number(), leaf) == Found::file &&
      ::unlinkat(folder.number(), leaf.c_str(), 0) != 0 && errno != ENOENT) {
    fail_at("remove", path_ / name, std::strerror(errno));
  }
}

void OutputFolder::State::clear(const std::string& first, const std::string& kept) {
  mark();
  const std::lock_guard lock(mutex_);
  manifest_ = read_manifest();
  if (manifest_.files.contains(first)) {
    remove(first);
  }
  Manifest left;
  for (const std::string& name : manifest_.files) {
    if (name == kept) {
      left.files.insert(name);
    } else {
      remove(name);
    }
  }
  const std::vector<std::string> inner_first(manifest_.folders.rbegin(), manifest_.folders.rend());
  for (const std::string& name : inner_first) {
    const Descriptor folder = parent(name);
    const std::string leaf = folder_and_leaf(name).second;
    if (folder.is_open() && ::unlinkat(folder.number(), leaf.c_str(), AT_REMOVEDIR) != 0 &&
        errno != ENOENT) {
      left.folders.insert(name);  // it is not empty
    }
  }
  left.temporary = {mark_of_process()};
  const Manifest before = std::exchange(manifest_, left);
  if (before != left) {
    left.files.insert(planned_.begin(), planned_.end());
    manifest_file().replace(before, left);
    manifest_ = read_manifest();
  }
}

void OutputFolder::State::flush() {
  std::set<std::string> names;
  {
    const std::lock_guard lock(mutex_);
    names.swap(not_flushed_);
  }
  const auto open = [this](const std::string& name) {
    const Descriptor folder = parent(name);
    Descriptor file(folder.is_open()
                        ? ::openat(folder.number(), folder_and_leaf(name).second.c_str(),
                                   O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)
                        : -1);
    if (!file.is_open() && errno != ENOENT) {
      fail_at("write", path_ / name, std::strerror(errno));
    }
    return file;
  };
  for (const std::string& name : names) {  // all on their way before the first is waited for
    ::sync_file_range(open(name).number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  }
  for (const std::string& name : names) {
    const Descriptor file = open(name);
    if (file.is_open() && ::fsync(file.number()) != 0) {
      fail_at("write", path_ / name, std::strerror(errno));
    }
  }
}

void OutputFolder::State::remove_temporary_files() const {
  std::set<std::string> folders = manifest_.folders;
  folders.insert("");
  for (const std::string& name : manifest_.files) {
    folders.insert(folder_and_leaf(name).first);
  }
  for (const std::string& below : folders) {
    const Descriptor folder = parent(below.empty() ? below : below + "/");
    if (!folder.is_open() || manifest_.temporary.empty()) {
      continue;
    }
    for (const std::string& name : names_in(folder.number())) {
      const std::size_t end = name.rfind('-');
      if (name.starts_with(kTemporary) && end > kTemporary.size() &&
          manifest_.temporary.contains(name.substr(kTemporary.size(), end - kTemporary.size()))) {
        remove_if_abandoned(folder.number(), name);
      }
    }
  }
}

OutputFolder::OutputFolder(const fs::path& path) : state_(std::make_shared<State>(path, false)) {}

OutputFolder::OutputFolder(std::shared_ptr<State> state, std::string prefix)
    : state_(std::move(state)), prefix_(std::move(prefix)) {}

OutputFolder OutputFolder::subfolder(const std::string& name) const {
  return {state_, prefix_ + name + "/"};
}

fs::path OutputFolder::path() const {
  return prefix_.empty() ? state_->path() : state_->path() / prefix_.substr(0, prefix_.size() - 1);
}

fs::path OutputFolder::path(const std::string& name) const {
  return state_->path() / (prefix_ + name);
}

bool OutputFolder::owns(const std::string& name) const {
  return state_->owns(prefix_ + name);
}

std::vector<std::string> OutputFolder::files() const {
  return state_->files(prefix_);
}

void OutputFolder::require_free(const std::string& name) const {
  state_->require_free(prefix_ + name);
}

void OutputFolder::plan(const std::set<std::string>& names) const {
  state_->plan(names);
}

void OutputFolder::make_folder(const std::string& name) const {
  state_->make_parent(prefix_ + name + "/");
}

AtomicFile OutputFolder::create(const std::string& name, Replace replace) const {
  const std::string whole = prefix_ + name;
  if (replace == Replace::own && !is_inside(whole)) {
    fail_at("write", path(name), "it is no name of a file");
  }
  if (replace == Replace::named) {
    state_->require_folder(path(name));
    if (name.starts_with(".clca")) {
      fail_at("write", path(name), "clca has files of its own with such names");
    }
  }
  auto file = std::make_unique<AtomicFile::State>();
  file->path = path(name);
  file->folder = state_->make_parent(whole);
  file->name = folder_and_leaf(whole).second;
  if (replace == Replace::own) {
    require_free(name);
    file->claim = [state = state_, whole] { return state->claim(whole); };
    file->disown = [state = state_, whole] { state->disown(whole); };
    if (state_->delays_flushing()) {
      file->flush_later = [state = state_, whole] { state->flush_later(whole); };
    }
  } else {
    if (found_in(file->folder.number(), file->name) == Found::other) {
      fail_at("write", file->path, "it is not a regular file");
    }
    file->claim = [state = state_] { return true; };
  }
  state_->mark();
  std::tie(file->file, file->temporary) = locked_temporary_file(file->folder.number(), file->path);
  return AtomicFile(std::move(file));
}

void OutputFolder::write(const std::string& name, std::span<const std::uint8_t> bytes,
                         Replace replace) const {
  AtomicFile file = create(name, replace);
  file.write(bytes);
  file.finish();
}

void OutputFolder::write(const std::string& name, std::string_view text, Replace replace) const {
  write(name, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), replace);
}

int OutputFolder::open_to_append(const std::string& name) const {
  const std::string whole = prefix_ + name;
  const Descriptor folder = state_->make_parent(whole);
  require_free(name);
  const bool known = state_->claim(whole);
  const std::string leaf = folder_and_leaf(whole).second;
  const bool there = found_in(folder.number(), leaf) != Found::nothing;
  Descriptor file(::openat(folder.number(), leaf.c_str(),
                           O_WRONLY | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC |
                               (known && there ? 0 : O_CREAT | O_EXCL),
                           kReadableByAll));
  if (!file.is_open() && errno == EEXIST) {
    state_->disown(whole);
    refuse_foreign(path(name));
  }
  if (!file.is_open()) {
    fail_at("write", path(name), std::strerror(errno));
  }
  return file.release();
}

bool OutputFolder::truncate(const std::string& name, std::uint64_t bytes) const {
  require_free(name);
  const Descriptor folder = state_->parent(prefix_ + name);
  const std::string leaf = folder_and_leaf(prefix_ + name).second;
  if (!folder.is_open() || found_in(folder.number(), leaf) == Found::nothing) {
    return bytes == 0;
  }
  // Opened first: over NFS the size of a file that is not open may be an old one.
  Descriptor file(
      ::openat(folder.number(), leaf.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) {
    fail_at("write", path(name), std::strerror(errno));
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size < bytes || (size == bytes && status.st_nlink == 1)) {
    return size == bytes;
  }
  if (status.st_nlink > 1) {  // of a backup, which is not to be changed
    std::vector<std::uint8_t> block(1U << 16U);
    AtomicFile copy = create(name);
    ssize_t count = 0;
    while (copy.size() < bytes && (count = ::read(file.number(), block.data(), block.size())) > 0) {
      const std::uint64_t left = bytes - copy.size();
      copy.write(
          std::span(block).first(std::min<std::uint64_t>(left, static_cast<std::uint64_t>(count))));
    }
    copy.finish();
    return true;
  }
  if (::ftruncate(file.number(), static_cast<off_t>(bytes)) != 0) {
    fail_at("write", path(name), std::strerror(errno));
  }
  return true;
}

void OutputFolder::delay_flushing() const {
  state_->delay_flushing();
}

void OutputFolder::flush_later(const std::string& name) const {
  state_->flush_later(prefix_ + name);
}

void OutputFolder::flush() const {
  state_->flush();
}

void OutputFolder::rename(const std::string& from, const std::string& to) const {
  require_free(from);
  require_free(to);
  const Descriptor folder = state_->parent(prefix_ + from);
  const Descriptor target = state_->parent(prefix_ + to);
  if (!folder.is_open() || !target.is_open() ||
      found_in(folder.number(), folder_and_leaf(prefix_ + from).second) == Found::nothing) {
    return;
  }
  state_->claim(prefix_ + to);
  if (::renameat(folder.number(), folder_and_leaf(prefix_ + from).second.c_str(), target.number(),
                 folder_and_leaf(prefix_ + to).second.c_str()) != 0 &&
      errno != ENOENT) {
    fail_at("write", path(to), std::strerror(errno));
  }
}

void OutputFolder::remove(const std::string& name) const {
  if (owns(name)) {
    state_->remove(prefix_ + name);
    state_->disown(prefix_ + name);
  }
}

void OutputFolder::clear(const std::string& first, const std::string& kept) const {
  state_->clear(first, kept);
}

void OutputFolder::remove_temporary_files() const {
  state_->remove_temporary_files();
}

OutputFile named_file(const fs::path& path) {
  return {OutputFolder(std::make_shared<OutputFolder::State>(path.parent_path(), true), ""),
          path.filename().string(), Replace::named};
}

OutputFolder named_folder(const fs::path& named, const fs::path& run, const std::string& below) {
  return named.empty() ? OutputFolder(run).subfolder(below) : OutputFolder(named);
}

}  // namespace clca::store
