#pragma once
// HDF5 files with a checksum header, readable by any HDF5 program, and in the namespace hdf5
// wrappers for the C interface of the library: objects that close themselves, errors that throw.

#include <hdf5.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "store/checksum_header.hpp"

namespace clca::store {

/// A number of a dataset, not a text.
template <class T>
concept Number = std::is_arithmetic_v<T> && !std::same_as<T, char>;

struct Meaning {
  std::string_view unit;  ///< empty for pure numbers, names and texts
  std::string text;       ///< description; may be empty
};

/// A dataset in memory: rows of `columns` numbers, a list of texts or a single one. It is written
/// from these values, or read into them. Its path is relative to the root.
struct Hdf5Dataset {
  /// Numbers in the order of number_type() in hdf5.cpp, then texts.
  using Values = std::variant<std::vector<std::uint8_t>*, std::vector<std::uint16_t>*,
                              std::vector<std::uint32_t>*, std::vector<std::uint64_t>*,
                              std::vector<std::int32_t>*, std::vector<double>*,
                              std::vector<std::string>*, std::string*>;
  std::string path;
  Values values;
  std::size_t numbers_per_row = 1;
  Meaning meaning = {};
  bool may_be_missing = false;  ///< then no values are read
};

namespace hdf5 {

/// A failed HDF5 call. what() is the operation or the problem.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// If a call has failed, throws std::bad_alloc if HDF5 reports lack of memory, else Error with
/// `what`.
void check(std::int64_t result, const char* what);

/// An HDF5 object, closed at the end of its scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws as check() if the call that returned `id` has failed.
  Handle(hid_t id, Close close, const char* what) : id_(id), close_(close) { check(id, what); }
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

inline Handle make_properties(hid_t of) {
  return {H5Pcreate(of), H5Pclose, "properties"};
}

/// The type of the numbers, in the byte order of the machine, which HDF5 records.
hid_t number_type(const Hdf5Dataset::Values& values);

/// The dataspace of a dataset with these dimensions; none: a single value.
Handle dataspace(const std::vector<hsize_t>& extent);
/// The dataspace of rows of so many numbers; of one number it has one dimension.
Handle dataspace(hsize_t rows, std::size_t columns);

/// Adds a dataset without its values, and the groups of its path, with the attributes `units` (of a
/// pure number "1") and `description`, as UTF-8. `creation`: its properties.
Handle make_dataset(const Handle& file, const Hdf5Dataset& dataset, hid_t type, const Handle& space,
                    const Handle& creation);

/// Adds a dataset to a file. Many numbers are chunked and compressed. Throws as check().
void add_dataset(const Handle& file, const Hdf5Dataset& dataset);

/// The bytes of an HDF5 file that `fill` creates, without a header. Throws StoreError: `cannot
/// write PATH: REASON`.
std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path,
                                     const std::function<void(const Handle& file)>& fill);

}  // namespace hdf5

inline constexpr double kNoByteLimit = 1e18;

/// Reads these datasets of a file whose checksum is right. `max_bytes`: memory limit for three
/// copies of the file, and the data.
/// Throws StoreError with the path for a file that is truncated, damaged, or of another kind or
/// version, and for datasets that are missing, of another type or extent, or too large.
void read_hdf5(const std::filesystem::path& path, const FileKind& kind,
               const std::vector<Hdf5Dataset>& datasets, double max_bytes);

}  // namespace clca::store
