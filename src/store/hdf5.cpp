#include "store/hdf5.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <new>

#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::store::hdf5 {

namespace {

/// A child process gets the library between two calls, and free.
std::mutex& library() {
  static std::mutex mutex;
  static const int kFailed =
      ::pthread_atfork([] { mutex.lock(); }, [] { mutex.unlock(); }, [] { mutex.unlock(); });
  if (kFailed != 0) {
    throw std::bad_alloc();
  }
  return mutex;
}

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
      H5Acreate2(object.id(), name, type.id(), space_of({}).id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, "attribute");
  const char* characters = text.c_str();
  check(H5Awrite(attribute.id(), type.id(), &characters), "attribute");
}

/// Properties of a file in memory.
Handle in_memory() {
  constexpr std::size_t kGrowth = 1U << 18U;
  Handle access = properties(H5P_FILE_ACCESS);
  check(H5Pset_fapl_core(access.id(), kGrowth, false), "memory driver");
  return access;
}

/// The library takes two files of one name for one; one that could not be closed keeps its name.
std::string new_name() {
  static std::uint64_t count = 0;
  return fmt::format("clca-image-{}", ++count);
}

}  // namespace

void fail(const char* what) {
  bool is_short = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note_shortage, &is_short);
  if (is_short) {
    throw std::bad_alloc();
  }
  throw Error(what);
}

Handle space_of(const std::vector<hsize_t>& extent) {
  return {extent.empty()
              ? H5Screate(H5S_SCALAR)
              : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
          H5Sclose, "extent"};
}

Handle make_dataset(const Handle& file, const std::string& path, hid_t type, const Handle& space,
                    const Handle& creation, const Meaning& meaning) {
  check(H5Pset_obj_track_times(creation.id(), false), "times");  // equal content, equal bytes
  const Handle links = properties(H5P_LINK_CREATE);
  check(H5Pset_create_intermediate_group(links.id(), 1), "groups");
  check(H5Pset_char_encoding(links.id(), H5T_CSET_UTF8), "encoding");
  Handle dataset(
      H5Dcreate2(file.id(), path.c_str(), type, space.id(), links.id(), creation.id(), H5P_DEFAULT),
      H5Dclose, "dataset");
  if (!meaning.text.empty()) {
    add_text(dataset, "units", std::string(meaning.unit.empty() ? "1" : meaning.unit));
    add_text(dataset, "description", std::string(meaning.text));
  }
  return dataset;
}

Session::Session() : lock_(library()) {
  check(H5Eget_auto2(H5E_DEFAULT, &report_, &report_data_), "errors");
  check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr), "errors");
}

Session::~Session() {
  H5Eset_auto2(H5E_DEFAULT, report_, report_data_);
}

std::vector<std::uint8_t> image(const std::filesystem::path& path,
                                const std::function<void(const Handle& file)>& fill) {
  try {
    const Session session;
    const Handle file(H5Fcreate(new_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory().id()),
                      H5Fclose, "file");
    fill(file);
    check(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "flush");
    const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
    check(size < 0 ? -1 : 0, "size of the file");
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    check(H5Fget_file_image(file.id(), bytes.data(), bytes.size()) < 0 ? -1 : 0, "file");
    return bytes;
  } catch (const Error& error) {
    throw StoreError(
        fmt::format("cannot write {}: the HDF5 library: {}", path.string(), error.what()));
  }
}

Handle open_image(std::span<const std::uint8_t> bytes) {
  constexpr const char* kNone = "it is no HDF5 file";
  const Handle access = in_memory();
  check(H5Pset_file_image(access.id(), const_cast<std::uint8_t*>(bytes.data()), bytes.size()),
        kNone);
  return {H5Fopen(new_name().c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, kNone};
}

}  // namespace clca::store::hdf5

namespace clca::store {

void end_without_hdf5() {
  H5dont_atexit();
}

}  // namespace clca::store
