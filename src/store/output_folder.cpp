#include "clca/store/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "clca/store/checkpoint.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace fs = std::filesystem;

namespace {

constexpr const char* kManifest = ".clca.manifest";
constexpr std::string_view kHeader = "clca manifest 1";
constexpr double kMaxManifestBytes = 64 << 20;

/// The folders of the file "a/b/c": "a", "a/b".
std::vector<std::string> folders_of(const std::string& name) {
  std::vector<std::string> folders;
  for (std::size_t slash = name.find('/'); slash != std::string::npos;
       slash = name.find('/', slash + 1)) {
    folders.push_back(name.substr(0, slash));
  }
  return folders;
}

/// Whether a name stays inside its folder: each part is a safe file name.
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

bool is_real_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(fs::symlink_status(path, error));
}

void require_folder_or_nothing(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)) && !is_real_folder(folder)) {
    fail("write to", folder, "it is no folder, or a symbolic link, which is not followed");
  }
}

FileDescriptor opened(const fs::path& file, int flags) {
  return FileDescriptor(
      ::open(file.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kNewFileMode));
}

}  // namespace

/// The folder and its manifest. Names are relative to this folder. What is not const is called with
/// the mutex.
struct OutputFolder::State {
  explicit State(fs::path folder) : path(std::move(folder)) {
    std::error_code error;
    absolute = path.empty() ? fs::current_path(error) : fs::absolute(path, error);
    read_manifest();
  }

  fs::path at(const std::string& name) const { return absolute / name; }
  bool is_file(const std::string& name) const {
    const auto is_real = [this](const std::string& below) { return is_real_folder(at(below)); };
    std::error_code error;
    return std::ranges::all_of(folders_of(name), is_real) &&
           fs::is_regular_file(fs::symlink_status(at(name), error));
  }
  void remove(const std::string& name) const {
    if (is_file(name) && ::unlink(at(name).c_str()) != 0 && errno != ENOENT) {
      fail("remove", path / name);
    }
  }
  /// All that files of the manifest are in.
  std::set<std::string> folders() const {
    std::set<std::string> folders;
    for (const std::string& name : names) {
      const std::vector<std::string> of_file = folders_of(name);
      folders.insert(of_file.begin(), of_file.end());
    }
    return folders;
  }

  void read_manifest() {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(at(kManifest), error))) {
      return;
    }
    if (!opened(at(kManifest), O_RDONLY).is_open()) {  // a symbolic link
      fail("read", path / kManifest);
    }
    const std::vector<std::uint8_t> bytes = read_whole_file(at(kManifest), kMaxManifestBytes);
    std::istringstream text(std::string(bytes.begin(), bytes.end()));
    std::string line;
    if (std::getline(text, line) && line != kHeader) {
      fail("read", path / kManifest, "it is not a clca manifest");
    }
    is_marked = true;
    constexpr std::string_view kBefore = "file \"";
    while (std::getline(text, line)) {
      if (line.starts_with(kBefore) && line.size() > kBefore.size() && line.back() == '"') {
        names.insert(line.substr(kBefore.size(), line.size() - kBefore.size() - 1));
      }
    }
    if (!std::ranges::all_of(names, is_inside)) {
      fail("read", path / kManifest, "it names files outside of the folder");
    }
  }
  void add_to_manifest(std::string text) {
    FileDescriptor file = opened(at(kManifest), O_WRONLY | O_APPEND | O_CREAT);
    struct stat status {};
    if (file.is_open() && ::fstat(file.number(), &status) == 0 && status.st_size == 0) {
      text.insert(0, std::string(kHeader) + "\n");
    }
    if (!file.is_open() || !write_all(file.number(), as_bytes(text)) || !file.close()) {
      fail("write", path / kManifest);
    }
    is_marked = true;
    not_flushed.insert(kManifest);
  }
  void make_folders(const std::string& name) const {
    if (!is_marked) {
      store::make_folder(absolute);
    }
    for (const std::string& below : folders_of(name)) {
      const fs::path folder = at(below);
      if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) {
        fail("make the folder", path / below / "");
      }
      require_folder_or_nothing(folder);
    }
  }
  /// Prepares a file to be written: makes its folders and lists it.
  void prepare(const std::string& name) {
    if (!is_inside(name)) {
      fail("write", path / name, "it is no name of a file");
    }
    make_folders(name);
    if (!std::exchange(has_written, true)) {
      remove_abandoned_files(absolute);
      for (const std::string& below : folders()) {
        remove_abandoned_files(at(below));
      }
    }
    if (!names.contains(name)) {
      add_to_manifest(fmt::format("\nfile \"{}\"\n", name));  // a line may have been cut off
      names.insert(name);
    }
  }

  fs::path path;  // as given
  fs::path absolute;
  std::atomic<bool> delays_flushing = false;
  std::mutex mutex;             // of what follows
  std::set<std::string> names;  // of the manifest
  bool is_marked = false;       // there is a manifest
  bool has_written = false;
  std::set<std::string> not_flushed;
};

OutputFolder::OutputFolder(const fs::path& path) : state_(std::make_shared<State>(path)) {}

OutputFolder OutputFolder::subfolder(const std::string& name) const {
  OutputFolder inner = *this;
  inner.prefix_ += name + "/";
  return inner;
}

fs::path OutputFolder::path() const {
  return prefix_.empty() ? state_->path : state_->path / prefix_.substr(0, prefix_.size() - 1);
}

fs::path OutputFolder::path(const std::string& name) const {
  return state_->path / (prefix_ + name);
}

void OutputFolder::require_clca_folder(const std::string& beside) const {
  const std::lock_guard lock(state_->mutex);
  std::error_code error;
  fs::directory_iterator it(state_->absolute, error);
  if (error == std::errc::no_such_file_or_directory) {
    return;
  }
  for (const fs::directory_iterator end; !error && it != end && !state_->is_marked;
       it.increment(error)) {
    const std::string name = it->path().filename();
    if (!name.starts_with(".clca") && name != beside) {
      fail("write to", state_->path,
           fmt::format("clca did not make the folder, and there are files in it ({}); "
                       "write elsewhere",
                       text::shortened(name)));
    }
  }
  if (error) {
    fail("write to", state_->path, error.message());
  }
}

void OutputFolder::make_clca_folder(const std::string& beside) const {
  require_clca_folder(beside);
  const std::lock_guard lock(state_->mutex);
  state_->make_folders("");
  state_->add_to_manifest("");
}

bool OutputFolder::owns(const std::string& name) const {
  const std::lock_guard lock(state_->mutex);
  return state_->names.contains(prefix_ + name) && state_->is_file(prefix_ + name);
}

std::vector<std::string> OutputFolder::listed_files() const {
  const std::lock_guard lock(state_->mutex);
  std::vector<std::string> there;
  for (const std::string& name : state_->names) {
    if (name.starts_with(prefix_) && state_->is_file(name)) {
      there.push_back(name.substr(prefix_.size()));
    }
  }
  return there;
}

void OutputFolder::make_folder(const std::string& name) const {
  const std::lock_guard lock(state_->mutex);
  state_->make_folders(prefix_ + name + "/");
}

fs::path OutputFolder::prepare_file(const std::string& name) const {
  const std::lock_guard lock(state_->mutex);
  state_->prepare(prefix_ + name);
  return state_->at(prefix_ + name);
}

AtomicFile OutputFolder::create(const std::string& name) const {
  std::function<void()> later;
  if (state_->delays_flushing) {
    later = [folder = *this, name] { folder.flush_later(name); };
  }
  return {prepare_file(name), std::move(later)};
}

void OutputFolder::write(const std::string& name, std::span<const std::uint8_t> bytes) const {
  AtomicFile file = create(name);
  file.write(bytes);
  file.finish();
}

void OutputFolder::truncate(const std::string& name, std::uint64_t bytes) const {
  const FileDescriptor file = opened(state_->at(prefix_ + name), O_RDWR);
  if (!file.is_open() && errno == ENOENT) {
    return;
  }
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0 ||
      (std::cmp_greater(status.st_size, bytes) &&
       ::ftruncate(file.number(), static_cast<off_t>(bytes)) != 0)) {
    fail("write", path(name));
  }
}

void OutputFolder::delay_flushing() const {
  state_->delays_flushing = true;
}

void OutputFolder::flush_later(const std::string& name) const {
  const std::lock_guard lock(state_->mutex);
  state_->not_flushed.insert(prefix_ + name);
}

void OutputFolder::flush() const {
  std::set<std::string> names;
  {
    const std::lock_guard lock(state_->mutex);
    names.swap(state_->not_flushed);
  }
  const auto open = [this](const std::string& name) {
    FileDescriptor file = opened(state_->at(name), O_RDONLY);
    if (!file.is_open() && errno != ENOENT) {
      fail("write", state_->path / name);
    }
    return file;
  };
  for (const std::string& name : names) {  // all on their way before the first is waited for
    ::sync_file_range(open(name).number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  }
  for (const std::string& name : names) {
    const FileDescriptor file = open(name);
    if (file.is_open() && ::fsync(file.number()) != 0) {
      fail("write", state_->path / name);
    }
  }
}

void OutputFolder::rename(const std::string& from, const std::string& to) const {
  const std::string there = prefix_ + from;
  if (state_->is_file(there) &&
      ::rename(state_->at(there).c_str(), prepare_file(to).c_str()) != 0) {
    fail("write", path(to));
  }
}

void OutputFolder::remove(const std::string& name) const {
  if (owns(name)) {
    state_->remove(prefix_ + name);
  }
}

void OutputFolder::clear(const std::string& first, const std::string& kept) const {
  const std::lock_guard lock(state_->mutex);
  state_->read_manifest();  // another process may have added names
  const std::set<std::string> folders = state_->folders();
  for (const std::string& below : folders) {  // before anything is lost
    require_folder_or_nothing(state_->at(below));
  }
  if (state_->names.contains(first)) {
    state_->remove(first);
  }
  for (const std::string& name : state_->names) {
    if (name != kept) {
      state_->remove(name);
    }
  }
  std::for_each(folders.rbegin(), folders.rend(),  // inner ones first
                [this](const std::string& below) { ::rmdir(state_->at(below).c_str()); });
}

OutputFolder named_folder(const fs::path& named, const fs::path& run, const std::string& below) {
  if (named.empty()) {
    return OutputFolder(run).subfolder(below);
  }
  OutputFolder folder(named);
  folder.require_clca_folder();
  return folder;
}

void GrowingFile::check_kept_bytes(const OutputFolder& folder, const std::string& name,
                                   std::uint64_t kept) {
  if (kept == 0) {
    return;
  }
  const fs::path path = folder.path(name);
  const auto refuse = [&path](const char* why) {
    throw UnusableCheckpointError(fmt::format("cannot go on with {}: {}", path.string(), why));
  };
  std::error_code missing;
  const std::uint64_t bytes = fs::file_size(path, missing);
  if (missing || bytes < kept) {
    refuse(missing ? "it is missing" : "it is shorter than when the checkpoint was made");
  }
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(kept - 1));
  if (file.get() != '\n') {
    refuse("it has been changed: no line ends where one did when the checkpoint was made");
  }
}

GrowingFile::GrowingFile(OutputFolder folder, std::string name, std::uint64_t kept)
    : folder_(std::move(folder)), name_(std::move(name)), bytes_(kept) {
  check_kept_bytes(folder_, name_, kept);
  if (kept == 0) {
    folder_.state_->remove(folder_.prefix_ + name_);
  } else {
    folder_.truncate(name_, kept);
  }
}

void GrowingFile::append(std::string_view text) {
  if (text.empty()) {
    return;
  }
  FileDescriptor file = opened(folder_.prepare_file(name_), O_WRONLY | O_APPEND | O_CREAT);
  if (!file.is_open()) {
    fail("write", folder_.path(name_));
  }
  if (!write_all(file.number(), as_bytes(text)) || !file.close()) {
    const std::string reason = std::strerror(errno);
    folder_.truncate(name_, bytes_);  // no half line
    fail("write", folder_.path(name_), reason);
  }
  bytes_ += text.size();
  folder_.flush_later(name_);
}

}  // namespace clca::store
