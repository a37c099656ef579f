#include "clca/store/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "clca/store/file.hpp"
#include "store/temporary_file.hpp"

namespace clca::store {

namespace {

[[noreturn]] void fail_writing(const std::filesystem::path& path) {
  throw StoreError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

}  // namespace

bool rename_without_replacing(int folder, const std::string& from, const std::string& to) {
  if (::renameat2(folder, from.c_str(), folder, to.c_str(), RENAME_NOREPLACE) == 0) {
    return true;
  }
  // Some file systems (NFS) do not support the flag.
  return (errno == EINVAL || errno == ENOSYS) &&
         ::linkat(folder, from.c_str(), folder, to.c_str(), 0) == 0 &&
         ::unlinkat(folder, from.c_str(), 0) == 0;
}

void refuse_foreign(const std::filesystem::path& path) {
  throw StoreError(fmt::format(
      "cannot write {}: clca did not write the file that is there; move it or write elsewhere",
      path.string()));
}

AtomicFile::State::~State() {
  if (!temporary.empty()) {
    ::unlinkat(folder.number(), temporary.c_str(), 0);
  }
}

AtomicFile::AtomicFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
AtomicFile::~AtomicFile() = default;
AtomicFile::AtomicFile(AtomicFile&& other) noexcept = default;

std::filesystem::path AtomicFile::temporary_path() const {
  return state_->path.parent_path() / state_->temporary;
}

std::uint64_t AtomicFile::size() const {
  return state_->size;
}

void AtomicFile::write(std::span<const std::uint8_t> bytes) {
  if (!write_all(state_->file.number(), bytes)) {
    fail_writing(state_->path);
  }
  state_->size += bytes.size();
  state_->flushed = false;
}

void AtomicFile::write(std::string_view text) {
  write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void AtomicFile::flush() {
  if (::fsync(state_->file.number()) != 0) {
    fail_writing(state_->path);
  }
  state_->flushed = true;
}

void AtomicFile::finish() {
  State& state = *state_;
  const bool later = !state.flushed && state.flush_later;
  if (!state.flushed && !later) {
    flush();
  }
  const int folder = state.folder.number();
  const bool renamed = state.list_and_name([&](bool replace) {
    return replace ? ::renameat(folder, state.temporary.c_str(), folder, state.name.c_str()) == 0
                   : rename_without_replacing(folder, state.temporary, state.name);
  });
  if (!renamed && errno == EEXIST) {
    refuse_foreign(state.path);
  }
  if (!renamed || !state.file.close()) {
    fail_writing(state.path);
  }
  state.temporary.clear();
  if (later) {
    state.flush_later();
  }
}

}  // namespace clca::store
