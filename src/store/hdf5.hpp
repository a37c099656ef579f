#pragma once
// A little order for the C interface of HDF5, which runs in child processes only: objects that
// close themselves, errors that throw.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace clca::store::hdf5 {

/// A call of HDF5 that failed: what() says what was wanted or what is wrong.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws std::bad_alloc where HDF5 says that memory is short, else Error, naming `what`.
[[noreturn]] void fail(const char* what);

/// Throws where a call has failed, as fail() does.
inline void check(herr_t result, const char* what) {
  if (result < 0) {
    fail(what);
  }
}

/// An object of HDF5, closed at the end of its scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws when the call that gave `id` has failed, as fail() does.
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

/// To be called first in a child: no error on the terminal, no code from other files.
void begin();

/// The bytes of an HDF5 file that `fill` makes in a child process. Throws StoreError: `cannot write
/// PATH: REASON`.
std::vector<std::uint8_t> image(const std::filesystem::path& path,
                                const std::function<void(const Handle& file)>& fill);

}  // namespace clca::store::hdf5
