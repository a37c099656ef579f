#include "clca/store/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "clca/store/file.hpp"
#include "clca/text/message.hpp"
#include "clca/text/read.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace fs = std::filesystem;

namespace {

constexpr const char* kManifest = ".clca.manifest";
constexpr std::string_view kHeader = "clca manifest 1\n";
constexpr double kMaxManifestBytes = 64 << 20;

[[noreturn]] void fail_at(const char* what, const fs::path& path,
                          const char* reason = std::strerror(errno)) {
  throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), reason));
}

/// The folders of the file "a/b/c": "a/", "a/b/".
std::vector<std::string> folders_of(const std::string& name) {
  std::vector<std::string> folders;
  for (std::size_t slash = name.find('/'); slash != std::string::npos;
       slash = name.find('/', slash + 1)) {
    folders.push_back(name.substr(0, slash + 1));
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

Descriptor opened(const fs::path& file, int flags) {
  return Descriptor(
      ::open(file.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kReadableByAll));
}

}  // namespace

/// The folder and its manifest. Names are relative to this folder.
class OutputFolder::State {
 public:
  explicit State(const fs::path& path) : path_(path) {
    std::error_code error;
    at_ = path.empty() ? fs::current_path(error) : fs::absolute(path, error);
    read_manifest();
  }

  const fs::path& path() const { return path_; }
  fs::path at(const std::string& name) const { return at_ / name; }

  void require_own(const std::string& beside);
  void make_own(const std::string& beside);
  bool is_file(const std::string& name) const;
  bool owns(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return names_.contains(name) && is_file(name);
  }
  std::vector<std::string> files(const std::string& prefix);
  /// Prepares a file to be written: makes its folders and lists it.
  void prepare(const std::string& name);
  void make_folders(const std::string& name);
  void remove(const std::string& name) const;
  void clear(const std::string& first, const std::string& kept);
  void flush_later(const std::string& name) {
    const std::lock_guard lock(mutex_);
    not_flushed_.insert(name);
  }
  void flush();

  std::atomic<bool> delays_flushing = false;

 private:
  void read_manifest();
  /// `below`: a folder, with a slash at its end.
  void require_folder_or_nothing(const std::string& below) const;
  void list(const std::string& name);
  void add_to_manifest(std::string text);

  fs::path path_;                // as given
  fs::path at_;                  // absolute
  std::mutex mutex_;             // of what follows
  std::set<std::string> names_;  // of the manifest
  bool is_marked_ = false;       // there is a manifest
  bool has_written_ = false;
  std::set<std::string> not_flushed_;
};

void OutputFolder::State::read_manifest() {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(at(kManifest), error))) {
    return;
  }
  const Descriptor file = opened(at(kManifest), O_RDONLY);
  if (!file.is_open()) {
    fail_at("read", path_ / kManifest);
  }
  const std::vector<std::uint8_t> bytes = read_whole(at(kManifest), kMaxManifestBytes);
  const std::string text(bytes.begin(), bytes.end());
  if (!text.empty() && !text.starts_with(kHeader)) {
    fail_at("read", path_ / kManifest, "it is not a clca manifest");
  }
  is_marked_ = true;
  constexpr std::string_view kBefore = "file \"";
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = std::string_view(text).substr(start, end - start);
    start = end + 1;
    if (line.starts_with(kBefore) && line.size() > kBefore.size() && line.back() == '"') {
      names_.emplace(line.substr(kBefore.size(), line.size() - kBefore.size() - 1));
    }
  }
  if (!std::all_of(names_.begin(), names_.end(), is_inside)) {
    fail_at("read", path_ / kManifest, "it names files outside of the folder");
  }
}

void OutputFolder::State::require_own(const std::string& beside) {
  const std::lock_guard lock(mutex_);
  std::error_code error;
  fs::directory_iterator it(at_, error);
  if (error == std::errc::no_such_file_or_directory) {
    return;
  }
  for (const fs::directory_iterator end; !error && it != end && !is_marked_; it.increment(error)) {
    const std::string name = it->path().filename();
    if (!name.starts_with(".clca") && name != beside) {
      fail_at("write to", path_,
              fmt::format("clca did not make the folder, and there are files in it ({}); "
                          "write elsewhere",
                          text::shortened(name))
                  .c_str());
    }
  }
  if (error) {
    fail_at("write to", path_, std::strerror(error.value()));
  }
}

bool OutputFolder::State::is_file(const std::string& name) const {
  const std::vector<std::string> folders = folders_of(name);
  std::error_code error;
  return std::all_of(folders.begin(), folders.end(),
                     [this](const std::string& below) {
                       return is_real_folder(at(below.substr(0, below.size() - 1)));
                     }) &&
         fs::is_regular_file(fs::symlink_status(at(name), error));
}

std::vector<std::string> OutputFolder::State::files(const std::string& prefix) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> there;
  for (const std::string& name : names_) {
    if (name.starts_with(prefix) && is_file(name)) {
      there.push_back(name.substr(prefix.size()));
    }
  }
  return there;
}

void OutputFolder::State::make_folders(const std::string& name) {
  if (!is_marked_) {
    store::make_folder(at_);
  }
  for (const std::string& below : folders_of(name)) {
    const fs::path folder = at(below.substr(0, below.size() - 1));
    if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) {
      fail_at("make the folder", path_ / below);
    }
    require_folder_or_nothing(below);
  }
}

void OutputFolder::State::require_folder_or_nothing(const std::string& below) const {
  const fs::path folder = at(below.substr(0, below.size() - 1));
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)) && !is_real_folder(folder)) {
    fail_at("write to", folder, "it is no folder, or a symbolic link, which is not followed");
  }
}

void OutputFolder::State::prepare(const std::string& name) {
  if (!is_inside(name)) {
    fail_at("write", path_ / name, "it is no name of a file");
  }
  const std::lock_guard lock(mutex_);
  make_folders(name);
  if (!std::exchange(has_written_, true)) {
    std::set<std::string> folders = {""};
    for (const std::string& listed : names_) {
      const std::vector<std::string> of_file = folders_of(listed);
      folders.insert(of_file.begin(), of_file.end());
    }
    for (const std::string& below : folders) {
      remove_abandoned_files(at(below));
    }
  }
  list(name);
}

void OutputFolder::State::list(const std::string& name) {
  if (!names_.contains(name)) {
    add_to_manifest(fmt::format("\nfile \"{}\"\n", name));  // a line may have been cut off
    names_.insert(name);
  }
}

void OutputFolder::State::add_to_manifest(std::string text) {
  Descriptor file = opened(at(kManifest), O_WRONLY | O_APPEND | O_CREAT);
  struct stat status {};
  if (file.is_open() && ::fstat(file.number(), &status) == 0 && status.st_size == 0) {
    text.insert(0, kHeader);
  }
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!file.is_open() || !write_all(file.number(), bytes) || !file.close()) {
    fail_at("write", path_ / kManifest);
  }
  is_marked_ = true;
  not_flushed_.insert(kManifest);
}

void OutputFolder::State::make_own(const std::string& beside) {
  require_own(beside);
  const std::lock_guard lock(mutex_);
  make_folders("");
  add_to_manifest("");
}

void OutputFolder::State::remove(const std::string& name) const {
  if (is_file(name) && ::unlink(at(name).c_str()) != 0 && errno != ENOENT) {
    fail_at("remove", path_ / name);
  }
}

void OutputFolder::State::clear(const std::string& first, const std::string& kept) {
  const std::lock_guard lock(mutex_);
  read_manifest();  // another process may have added names
  std::set<std::string> folders;
  for (const std::string& name : names_) {
    const std::vector<std::string> of_file = folders_of(name);
    folders.insert(of_file.begin(), of_file.end());
  }
  for (const std::string& below : folders) {  // before anything is lost
    require_folder_or_nothing(below);
  }
  if (names_.contains(first)) {
    remove(first);
  }
  for (const std::string& name : names_) {
    if (name != kept) {
      remove(name);
    }
  }
  std::for_each(folders.rbegin(), folders.rend(),  // inner ones first
                [this](const std::string& below) { ::rmdir(at(below).c_str()); });
}

void OutputFolder::State::flush() {
  std::set<std::string> names;
  {
    const std::lock_guard lock(mutex_);
    names.swap(not_flushed_);
  }
  const auto open = [this](const std::string& name) {
    Descriptor file = opened(at(name), O_RDONLY);
    if (!file.is_open() && errno != ENOENT) {
      fail_at("write", path_ / name);
    }
    return file;
  };
  for (const std::string& name : names) {  // all on their way before the first is waited for
    ::sync_file_range(open(name).number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  }
  for (const std::string& name : names) {
    const Descriptor file = open(name);
    if (file.is_open() && ::fsync(file.number()) != 0) {
      fail_at("write", path_ / name);
    }
  }
}

OutputFolder::OutputFolder(const fs::path& path) : state_(std::make_shared<State>(path)) {}

OutputFolder::OutputFolder(std::shared_ptr<State> state, std::string prefix)
    : state_(std::move(state)), prefix_(std::move(prefix)) {}

OutputFolder OutputFolder::subfolder(const std::string& name) const {
  return {state_, prefix_ + name + "/"};
}

fs::path OutputFolder::path() const {
  const fs::path& root = state_->path();
  return prefix_.empty() ? root : root / prefix_.substr(0, prefix_.size() - 1);
}

fs::path OutputFolder::path(const std::string& name) const {
  return state_->path() / (prefix_ + name);
}

void OutputFolder::require_own(const std::string& beside) const {
  state_->require_own(beside);
}

void OutputFolder::make_own(const std::string& beside) const {
  state_->make_own(beside);
}

bool OutputFolder::owns(const std::string& name) const {
  return state_->owns(prefix_ + name);
}

std::vector<std::string> OutputFolder::files() const {
  return state_->files(prefix_);
}

void OutputFolder::make_folder(const std::string& name) const {
  state_->make_folders(prefix_ + name + "/");
}

AtomicFile OutputFolder::create(const std::string& name) const {
  const std::string whole = prefix_ + name;
  state_->prepare(whole);
  return {state_->at(whole), state_->delays_flushing
                                 ? [state = state_, whole] { state->flush_later(whole); }
                                 : std::function<void()>()};
}

void OutputFolder::write(const std::string& name, std::span<const std::uint8_t> bytes) const {
  AtomicFile file = create(name);
  file.write(bytes);
  file.finish();
}

void OutputFolder::write(const std::string& name, std::string_view text) const {
  write(name, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

int OutputFolder::open_to_append(const std::string& name) const {
  state_->prepare(prefix_ + name);
  Descriptor file = opened(state_->at(prefix_ + name), O_WRONLY | O_APPEND | O_CREAT);
  if (!file.is_open()) {
    fail_at("write", path(name));
  }
  return file.release();
}

bool OutputFolder::truncate(const std::string& name, std::uint64_t bytes) const {
  const Descriptor file = opened(state_->at(prefix_ + name), O_RDWR);
  if (!file.is_open() && errno == ENOENT) {
    return bytes == 0;
  }
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) {
    fail_at("write", path(name));
  }
  if (std::cmp_less(status.st_size, bytes)) {
    return false;
  }
  if (::ftruncate(file.number(), static_cast<off_t>(bytes)) != 0) {
    fail_at("write", path(name));
  }
  return true;
}

void OutputFolder::delay_flushing() const {
  state_->delays_flushing = true;
}

void OutputFolder::flush_later(const std::string& name) const {
  state_->flush_later(prefix_ + name);
}

void OutputFolder::flush() const {
  state_->flush();
}

void OutputFolder::rename(const std::string& from, const std::string& to) const {
  if (!state_->is_file(prefix_ + from)) {
    return;
  }
  state_->prepare(prefix_ + to);
  if (::rename(state_->at(prefix_ + from).c_str(), state_->at(prefix_ + to).c_str()) != 0) {
    fail_at("write", path(to));
  }
}

void OutputFolder::remove(const std::string& name) const {
  if (owns(name)) {
    state_->remove(prefix_ + name);
  }
}

void OutputFolder::discard(const std::string& name) const {
  state_->remove(prefix_ + name);
}

void OutputFolder::clear(const std::string& first, const std::string& kept) const {
  state_->clear(first, kept);
}

OutputFolder named_folder(const fs::path& named, const fs::path& run, const std::string& below) {
  if (named.empty()) {
    return OutputFolder(run).subfolder(below);
  }
  OutputFolder folder(named);
  folder.require_own();
  return folder;
}

}  // namespace clca::store
