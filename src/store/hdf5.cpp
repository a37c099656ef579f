#include "store/hdf5.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <new>
#include <span>

#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::store {

namespace hdf5 {

namespace {

/// One thread at a time uses the library. A child process gets it between two calls, and free.
std::mutex& library_mutex() {
  static std::mutex mutex;
  static const int kFailed =
      ::pthread_atfork([] { mutex.lock(); }, [] { mutex.unlock(); }, [] { mutex.unlock(); });
  if (kFailed != 0) {
    throw std::bad_alloc();
  }
  return mutex;
}

/// The library, for one thread at a time, without error output. Others may use it in this process,
/// too, so it stays as it was found.
class Session {
 public:
  Session() : lock_(library_mutex()) {
    check(H5Eget_auto2(H5E_DEFAULT, &report_, &report_data_), "errors");
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr), "errors");
  }
  ~Session() { H5Eset_auto2(H5E_DEFAULT, report_, report_data_); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t report_ = nullptr;  // of errors, by others
  void* report_data_ = nullptr;
};

herr_t note_shortage(unsigned /*depth*/, const H5E_error2_t* error, void* is_short) {
  if (error->maj_num == H5E_RESOURCE || error->min_num == H5E_NOSPACE ||
      error->min_num == H5E_CANTALLOC) {
    *static_cast<bool*>(is_short) = true;
  }
  return 0;
}

void add_text(const Handle& object, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  check(H5Tset_size(type.id(), H5T_VARIABLE), "text size");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "encoding");
  const Handle attribute(
      H5Acreate2(object.id(), name, type.id(), dataspace({}).id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, "attribute");
  const char* characters = text.c_str();
  check(H5Awrite(attribute.id(), type.id(), &characters), "attribute");
}

/// Access properties of a file that is only in memory.
Handle memory_file_access() {
  constexpr std::size_t kGrowth = 1U << 18U;
  Handle access = make_properties(H5P_FILE_ACCESS);
  check(H5Pset_fapl_core(access.id(), kGrowth, false), "memory driver");
  return access;
}

/// The library takes two files of one name for one; one that could not be closed keeps its name.
std::string new_file_name() {
  static std::uint64_t count = 0;
  return fmt::format("clca-image-{}", ++count);
}

/// A copy of such bytes as a file to be read, within a Session.
Handle open_image(std::span<const std::uint8_t> bytes) {
  constexpr const char* kNone = "it is no HDF5 file";
  const Handle access = memory_file_access();
  check(H5Pset_file_image(access.id(), const_cast<std::uint8_t*>(bytes.data()), bytes.size()),
        kNone);
  return {H5Fopen(new_file_name().c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, kNone};
}

}  // namespace

void check(std::int64_t result, const char* what) {
  if (result >= 0) {
    return;
  }
  bool is_short = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note_shortage, &is_short);
  if (is_short) {
    throw std::bad_alloc();
  }
  throw Error(what);
}

hid_t number_type(const Hdf5Dataset::Values& values) {
  const std::array types = {H5T_NATIVE_UINT8,  H5T_NATIVE_UINT16, H5T_NATIVE_UINT32,
                            H5T_NATIVE_UINT64, H5T_NATIVE_INT32,  H5T_NATIVE_DOUBLE};
  static_assert(std::variant_size_v<Hdf5Dataset::Values> == std::tuple_size_v<decltype(types)> + 2);
  if (values.index() >= types.size()) {
    throw Error("is no number");
  }
  return types.at(values.index());
}

Handle dataspace(const std::vector<hsize_t>& extent) {
  return {extent.empty()
              ? H5Screate(H5S_SCALAR)
              : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
          H5Sclose, "extent"};
}

Handle dataspace(hsize_t rows, std::size_t columns) {
  return columns == 1 ? dataspace({rows}) : dataspace({rows, columns});
}

Handle make_dataset(const Handle& file, const Hdf5Dataset& dataset, hid_t type, const Handle& space,
                    const Handle& creation) {
  check(H5Pset_obj_track_times(creation.id(), false), "times");  // equal content, equal bytes
  const Handle links = make_properties(H5P_LINK_CREATE);
  check(H5Pset_create_intermediate_group(links.id(), 1), "groups");
  check(H5Pset_char_encoding(links.id(), H5T_CSET_UTF8), "encoding");
  Handle made(H5Dcreate2(file.id(), dataset.path.c_str(), type, space.id(), links.id(),
                         creation.id(), H5P_DEFAULT),
              H5Dclose, "dataset");
  if (const auto& [unit, text] = dataset.meaning; !text.empty()) {
    add_text(made, "units", std::string(unit.empty() ? "1" : unit));
    add_text(made, "description", text);
  }
  return made;
}

std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path,
                                     const std::function<void(const Handle& file)>& fill) {
  try {
    const Session session;
    const Handle file(
        H5Fcreate(new_file_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, memory_file_access().id()),
        H5Fclose, "file");
    fill(file);
    check(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "flush");
    const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
    check(size, "size of the file");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    check(H5Fget_file_image(file.id(), bytes.data(), bytes.size()), "file");
    return bytes;
  } catch (const Error& error) {
    throw StoreError(
        fmt::format("cannot write {}: the HDF5 library: {}", path.string(), error.what()));
  }
}

}  // namespace hdf5

using hdf5::check;
using hdf5::Error;
using hdf5::Handle;

namespace {

/// Properties of a dataset of numbers.
Handle creation_properties(hsize_t rows, hsize_t columns, std::size_t number_bytes) {
  constexpr std::size_t kSmall = 4096;         // bytes that are not worth compressing
  constexpr hsize_t kChunkNumbers = 1U << 16;  // in a chunk
  constexpr unsigned kDeflateLevel = 1;  // more costs time and gains little on shuffled numbers
  Handle creation = hdf5::make_properties(H5P_DATASET_CREATE);
  if (rows * columns * number_bytes > kSmall) {
    const std::array<hsize_t, 2> chunk = {
        std::min(rows, std::max<hsize_t>(1, kChunkNumbers / columns)), columns};
    check(H5Pset_chunk(creation.id(), columns == 1 ? 1 : 2, chunk.data()), "chunks");
    check(H5Pset_shuffle(creation.id()), "shuffle");
    check(H5Pset_deflate(creation.id(), kDeflateLevel), "compression");
  }
  return creation;
}

void write_dataset(const Handle& file, const Hdf5Dataset& dataset, hid_t type, const Handle& space,
                   const Handle& creation, const void* data) {
  const Handle made = hdf5::make_dataset(file, dataset, type, space, creation);
  check(H5Dwrite(made.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write");
}

/// All in cells of one length, padded with zeros.
void write_texts(const Handle& file, const Hdf5Dataset& dataset, std::span<const std::string> texts,
                 const Handle& space) {
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    longest = std::max(longest, text.size());
  }
  std::string cells;
  for (const std::string& text : texts) {
    cells += text;
    cells.resize(cells.size() + longest - text.size());
  }
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  check(H5Tset_size(type.id(), longest), "text size");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "encoding");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "padding");
  write_dataset(file, dataset, type.id(), space, hdf5::make_properties(H5P_DATASET_CREATE),
                cells.data());
}

/// Number of rows and columns; lists have one column.
using Extent = std::array<hsize_t, 2>;

Extent extent_of(const Handle& dataset) {
  Extent extent = {1, 1};
  const Handle space(H5Dget_space(dataset.id()), H5Sclose, "has no extent");
  if (H5Sget_simple_extent_ndims(space.id()) > 2 ||
      H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr) < 0) {
    throw Error("has an unexpected extent");
  }
  return extent;
}

Handle type_of(const Handle& dataset) {
  return {H5Dget_type(dataset.id()), H5Tclose, "has no type"};
}

void read_into(const Handle& dataset, const Handle& type, void* data) {
  check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "cannot be read");
}

/// All data read count, as the caller keeps them.
void take(double& bytes_left, const Extent& extent, double item_bytes) {
  bytes_left -= static_cast<double>(extent[0]) * static_cast<double>(extent[1]) * item_bytes;
  if (bytes_left < 0) {
    throw Error("needs more memory than the limit");
  }
}

template <Number T>
void read(const Handle& dataset, const Extent& extent, double& bytes_left, std::vector<T>& values) {
  const Handle type = type_of(dataset);
  if (H5Tequal(type.id(), hdf5::number_type(&values)) <= 0) {
    throw Error("holds other numbers");
  }
  take(bytes_left, extent, sizeof(T));
  values.resize(extent[0] * extent[1]);
  read_into(dataset, type, values.data());
}

void read(const Handle& dataset, const Extent& extent, double& bytes_left,
          std::vector<std::string>& texts) {
  const Handle type = type_of(dataset);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) {
    throw Error("is no text");
  }
  const std::size_t size = H5Tget_size(type.id());
  take(bytes_left, extent, sizeof(std::string) + 2 * static_cast<double>(size));
  std::string cells(extent[0] * extent[1] * size, '\0');
  read_into(dataset, type, cells.data());
  for (std::size_t at = 0; at < cells.size(); at += size) {
    std::string& text = texts.emplace_back(cells.substr(at, size));
    text.resize(text.find_last_not_of('\0') + 1);
  }
}

void read(const Handle& dataset, const Extent& extent, double& bytes_left, std::string& text) {
  std::vector<std::string> texts;
  read(dataset, extent, bytes_left, texts);
  text = texts.empty() ? "" : texts.front();
}

void read(const Handle& file, const Hdf5Dataset& wanted, double& bytes_left) {
  std::visit([](auto* values) { values->clear(); }, wanted.values);
  if (H5Lexists(file.id(), wanted.path.c_str(), H5P_DEFAULT) <= 0) {
    if (!wanted.may_be_missing) {
      throw Error("is missing");
    }
    return;
  }
  const Handle dataset(H5Dopen2(file.id(), wanted.path.c_str(), H5P_DEFAULT), H5Dclose,
                       "is no dataset");
  const Extent extent = extent_of(dataset);
  if (extent[1] != wanted.numbers_per_row) {
    throw Error(fmt::format("has {} columns", extent[1]));
  }
  std::visit([&](auto* values) { read(dataset, extent, bytes_left, *values); }, wanted.values);
}

}  // namespace

void hdf5::add_dataset(const Handle& file, const Hdf5Dataset& dataset) {
  std::visit(
      [&]<class T>(const T* values) {
        if constexpr (std::same_as<T, std::string>) {
          write_texts(file, dataset, {values, 1}, dataspace({}));
        } else if constexpr (std::same_as<T, std::vector<std::string>>) {
          write_texts(file, dataset, *values, dataspace({values->size()}));
        } else {
          const hsize_t rows = values->size() / dataset.numbers_per_row;
          write_dataset(
              file, dataset, number_type(dataset.values), dataspace(rows, dataset.numbers_per_row),
              creation_properties(rows, dataset.numbers_per_row, sizeof(typename T::value_type)),
              values->data());
        }
      },
      dataset.values);
}

void read_hdf5(const std::filesystem::path& path, const FileKind& kind,
               const std::vector<Hdf5Dataset>& datasets, double max_bytes) {
  constexpr double kCopies = 3;  // as it was read, and of the library
  const std::vector<std::uint8_t> file = read_whole_file(path, max_bytes);
  double bytes_left = max_bytes - kCopies * static_cast<double>(file.size());
  try {
    const auto content = content_of(kind, file);
    if (bytes_left < 0) {
      throw Error("it needs more memory than the limit");
    }
    const hdf5::Session session;
    const Handle opened = hdf5::open_image(content);
    for (const Hdf5Dataset& dataset : datasets) {
      try {
        read(opened, dataset, bytes_left);
      } catch (const Error& error) {
        throw Error(fmt::format("{} {}", dataset.path, error.what()));
      }
    }
  } catch (const std::runtime_error& error) {
    throw StoreError(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

void disable_hdf5_exit() {
  H5dont_atexit();
}

}  // namespace clca::store
