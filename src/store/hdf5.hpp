#pragma once
// A little order for the C interface of HDF5: objects that close themselves, errors that throw.

#include <hdf5.h>

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace clca::store::hdf5 {

/// A call of HDF5 that failed: what() says what was wanted or what is wrong.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An object of HDF5, closed at the end of its scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws Error, naming `what`, when the call that gave `id` has failed.
  Handle(hid_t id, Close close, const char* what) : id_(id), close_(close) {
    if (id < 0) {
      throw Error(what);
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

/// Throws Error where a call has failed.
inline void check(herr_t result, const char* what) {
  if (result < 0) {
    throw Error(what);
  }
}

/// For a file in memory: HDF5 takes two of one name for the same file.
std::string name_in_memory();

/// To be held while HDF5 is at work: one thread at a time, and no word of errors on the terminal.
class Session {
 public:
  Session();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

}  // namespace clca::store::hdf5
