#pragma once
// Wrappers for the C interface of HDF5: objects that close themselves, errors that throw.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "store/hdf5_file.hpp"

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

inline Handle properties(hid_t of) {
  return {H5Pcreate(of), H5Pclose, "properties"};
}

/// In the byte order of the machine, which HDF5 records.
template <Number T>
hid_t number_type() {
  struct Types {
    static hid_t of(std::uint8_t) { return H5T_NATIVE_UINT8; }
    static hid_t of(std::uint16_t) { return H5T_NATIVE_UINT16; }
    static hid_t of(std::uint32_t) { return H5T_NATIVE_UINT32; }
    static hid_t of(std::uint64_t) { return H5T_NATIVE_UINT64; }
    static hid_t of(std::int32_t) { return H5T_NATIVE_INT32; }
    static hid_t of(double) { return H5T_NATIVE_DOUBLE; }
  };
  return Types::of(T());
}

/// Rows and columns, and more dimensions, of a dataset; none: a single value.
Handle space_of(const std::vector<hsize_t>& extent);

/// Adds a dataset, and the groups of its path, with the attributes `units` (of a pure number "1")
/// and `description`, as UTF-8. `creation`: its properties.
Handle make_dataset(const Handle& file, const std::string& path, hid_t type, const Handle& space,
                    const Handle& creation, const Meaning& meaning);

/// The library, for one thread at a time, without error output. Others may use it in this process,
/// too, so it stays as it was found.
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

/// A copy of such bytes as a file to be read, within a Session.
Handle open_image(std::span<const std::uint8_t> bytes);

}  // namespace clca::store::hdf5
