#include "clca/store/output_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iterator>
#include <mutex>
#include <tuple>
#include <utility>

#include "clca/store/file.hpp"
#include "store/folder_tree.hpp"
#include "store/manifest.hpp"
#include "store/temporary_file.hpp"

namespace clca::store {

namespace fs = std::filesystem;

/// The open folder and its manifest. Names are relative to the root folder.
class OutputFolder::State {
 public:
  /// `named`: for files named by the user, where the manifest is needed for temporary files only.
  /// In a shared folder (/tmp) the manifest may belong to another user; then none is used.
  State(const fs::path& path, bool named) : tree_(path), named_(named) {
    if (!tree_.is_open() && !named_ && errno != ENOENT) {
      fail_at("write to", path, std::strerror(errno));
    }
    if (tree_.is_open()) {
      unless_named([this] { manifest_ = manifest_file().read(); });
    }
  }
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  const FolderTree& tree() const { return tree_; }
  /// Throws if the folder of a file named by the user does not exist.
  void require_folder(const fs::path& file) {
    tree_.open();
    if (!tree_.is_open()) {
      fail_at("write", file, std::strerror(errno));
    }
  }

  bool owns(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return manifest_.files.contains(name);
  }
  std::vector<std::string> files(const std::string& prefix);
  void require_free(const std::string& name);
  void plan(const std::set<std::string>& names);
  /// Lists a file, unless it is listed, and gives it its name. Replaces only its own.
  bool list_and_name(const std::string& name, const GiveName& give);
  /// Removes a file that is listed.
  void remove(const std::string& name);
  /// The folder of the file `name`, made if needed. Throws StoreError.
  Descriptor make_parent(const std::string& name);
  /// Lists the mark of this process before it makes its first temporary file.
  void mark();
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
  ManifestFile manifest_file() const {
    return {tree_.number(), tree_.path(),
            !manifest_.files.empty() || !manifest_.folders.empty() || !planned_.empty()};
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

  FolderTree tree_;
  bool named_;
  std::atomic<bool> delays_flushing_ = false;
  std::mutex mutex_;  // of all below, and of making the folder
  Manifest manifest_;
  std::set<std::string> planned_;  // listed before they are written
  std::set<std::string> not_flushed_;
  bool marked_ = false;
};

OutputFolder::State::~State() {
  if (!marked_) {
    return;
  }
  try {
    if (const std::set<std::string> unmade = only_planned(); !unmade.empty()) {
      manifest_file().remove_files(unmade);
    }
    if (!has_temporary_files(tree_.number())) {
      manifest_file().remove_if_empty();
    }
  } catch (const std::exception&) {  // it stays: that is harmless
  }
}

std::vector<std::string> OutputFolder::State::files(const std::string& prefix) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> there;
  for (const std::string& name : manifest_.files) {
    if (name.starts_with(prefix) && tree_.find(name) == Found::file) {
      there.push_back(name.substr(prefix.size()));
    }
  }
  return there;
}

void OutputFolder::State::require_free(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const Found found = tree_.find(name);
  if (found == Found::other) {
    fail_at("write", tree_.path() / name, "it is not a regular file");
  }
  if (found == Found::file && !manifest_.files.contains(name)) {
    manifest_.files.merge(read_manifest().files);
    if (!manifest_.files.contains(name)) {
      refuse_foreign(tree_.path() / name);
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

bool OutputFolder::State::list_and_name(const std::string& name, const GiveName& give) {
  const std::lock_guard lock(mutex_);
  if (manifest_.files.contains(name)) {
    return manifest_file().replace_file(name, give);
  }
  const bool planned = planned_.contains(name);
  const bool named = planned ? give(false) : manifest_file().add_file(name, give);
  if (named) {
    manifest_.files.insert(name);
  } else if (planned && errno == EEXIST) {
    planned_.erase(name);
    manifest_file().remove_files({name});
    errno = EEXIST;
  }
  return named;
}

void OutputFolder::State::remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (manifest_.files.contains(name)) {
    manifest_file().remove_file(name, [&] { tree_.remove(name); });
    manifest_.files.erase(name);
    planned_.erase(name);
  }
}

Descriptor OutputFolder::State::make_parent(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (!tree_.is_open()) {
    tree_.make();
  }
  return tree_.make_parent(name, [this](const std::string& folder) {
    manifest_file().add_folder(folder);
    manifest_.folders.insert(folder);
  });
}

void OutputFolder::State::mark() {
  const std::lock_guard lock(mutex_);
  if (!marked_) {
    remove_temporary_files();
    unless_named([this] { manifest_file().add_temporary(mark_of_process()); });
    marked_ = true;
  }
}

void OutputFolder::State::clear(const std::string& first, const std::string& kept) {
  mark();
  const std::lock_guard lock(mutex_);
  manifest_ = read_manifest();
  if (manifest_.files.contains(first)) {
    tree_.remove(first);
  }
  Manifest left;
  for (const std::string& name : manifest_.files) {
    if (name == kept) {
      left.files.insert(name);
    } else {
      tree_.remove(name);
    }
  }
  const std::vector<std::string> inner_first(manifest_.folders.rbegin(), manifest_.folders.rend());
  for (const std::string& name : inner_first) {
    if (!tree_.remove_folder(name)) {
      left.folders.insert(name);
    }
  }
  left.temporary = {mark_of_process()};
  const Manifest before = std::exchange(manifest_, left);
  if (before != left) {
    left.files.insert(planned_.begin(), planned_.end());
    manifest_file().replace(before, left, [this](const std::string& name) {
      return tree_.find(name) != Found::nothing;
    });
    manifest_ = read_manifest();
  }
}

void OutputFolder::State::flush() {
  std::set<std::string> names;
  {
    const std::lock_guard lock(mutex_);
    names.swap(not_flushed_);
  }
  tree_.flush(names);
}

void OutputFolder::State::remove_temporary_files() const {
  std::set<std::string> folders = manifest_.folders;
  folders.insert("");
  for (const std::string& name : manifest_.files) {
    folders.insert(folder_and_leaf(name).first);
  }
  for (const std::string& below : folders) {
    const Descriptor folder = tree_.parent(below.empty() ? below : below + "/");
    if (folder.is_open()) {
      remove_abandoned_files(folder.number(), manifest_.temporary);
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
  const fs::path& root = state_->tree().path();
  return prefix_.empty() ? root : root / prefix_.substr(0, prefix_.size() - 1);
}

fs::path OutputFolder::path(const std::string& name) const {
  return state_->tree().path() / (prefix_ + name);
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
    file->list_and_name = [state = state_, whole](const GiveName& give) {
      return state->list_and_name(whole, give);
    };
    if (state_->delays_flushing()) {
      file->flush_later = [state = state_, whole] { state->flush_later(whole); };
    }
  } else {
    if (found_in(file->folder.number(), file->name) == Found::other) {
      fail_at("write", file->path, "it is not a regular file");
    }
    // The folder is needed until the end, when it removes a manifest that is empty.
    file->list_and_name = [state = state_](const GiveName& give) { return give(true); };
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
  const std::string leaf = folder_and_leaf(whole).second;
  Descriptor file;
  const bool opened = state_->list_and_name(whole, [&](bool replace) {
    constexpr int kFlags = O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    file = Descriptor(
        ::openat(folder.number(), leaf.c_str(), kFlags | (replace ? 0 : O_EXCL), kReadableByAll));
    return file.is_open();
  });
  if (!opened && errno == EEXIST) {
    refuse_foreign(path(name));
  }
  if (!opened) {
    fail_at("write", path(name), std::strerror(errno));
  }
  return file.release();
}

bool OutputFolder::truncate(const std::string& name, std::uint64_t bytes) const {
  require_free(name);
  const Descriptor folder = state_->tree().parent(prefix_ + name);
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
  const Descriptor folder = state_->tree().parent(prefix_ + from);
  const Descriptor target = state_->tree().parent(prefix_ + to);
  if (!folder.is_open() || !target.is_open() ||
      found_in(folder.number(), folder_and_leaf(prefix_ + from).second) == Found::nothing) {
    return;
  }
  const bool renamed = state_->list_and_name(prefix_ + to, [&](bool /*replace*/) {
    return ::renameat(folder.number(), folder_and_leaf(prefix_ + from).second.c_str(),
                      target.number(), folder_and_leaf(prefix_ + to).second.c_str()) == 0;
  });
  if (!renamed && errno != ENOENT) {
    fail_at("write", path(to), std::strerror(errno));
  }
}

void OutputFolder::remove(const std::string& name) const {
  state_->remove(prefix_ + name);
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
