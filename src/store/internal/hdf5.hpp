#pragma once
// Wrappers for the C interface of HDF5: objects that close themselves, errors that throw.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace clca::store::hdf5 {

/// A failed HDF5 call. what() is the operation or the problem.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws std::bad_alloc if HDF5 reports lack of memory, else Error with `what`.
[[noreturn]] void fail(const char* what);

/// Throws as fail() if a call has failed.
inline void check(herr_t result, const char* what) {
  if (result < 0) {
    fail(what);
  }
}

/// An HDF5 object, closed at the end of its scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws as fail() if the call that returned `id` has failed.
  Handle(hid_t id, Close close, const char* what) : id_(id), close_(close) {
    if (id < 0) {
      fail(what);
    }
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) {
      close_(id_);
    }
  }

  hid_t id() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// Adds the attributes `units` and `description` to a dataset, as UTF-8. No unit is written as "1".
void describe(const Handle& dataset, std::string_view unit, std::string_view meaning);

/// The library, for one thread at a time, without error output. Others may use it in this process,
/// too, so it stays as it was found. Make one before a child process that makes one.
class Session {
 public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t report_ = nullptr;  // of errors, by others
  void* report_data_ = nullptr;
};

/// The bytes of an HDF5 file that `fill` creates. Throws StoreError: `cannot write PATH: REASON`.
std::vector<std::uint8_t> image(const std::filesystem::path& path,
                                const std::function<void(const Handle& file)>& fill);

}  // namespace clca::store::hdf5
