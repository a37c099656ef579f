#include "store/internal/hdf5.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <new>
#include <string>

#include "clca/store/file.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::store::hdf5 {

namespace {

herr_t note_shortage(unsigned /*depth*/, const H5E_error2_t* error, void* is_short) {
  if (error->maj_num == H5E_RESOURCE || error->min_num == H5E_NOSPACE ||
      error->min_num == H5E_CANTALLOC) {
    *static_cast<bool*>(is_short) = true;
  }
  return 0;
}

std::vector<std::uint8_t> bytes_of(const Handle& file) {
  check(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "flush");
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  check(size < 0 ? -1 : 0, "size of the file");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  check(H5Fget_file_image(file.id(), bytes.data(), bytes.size()) < 0 ? -1 : 0, "file");
  return bytes;
}

void add_text(const Handle& object, const char* name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text");
  check(H5Tset_size(type.id(), H5T_VARIABLE), "text size");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "encoding");
  const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "extent");
  const Handle attribute(
      H5Acreate2(object.id(), name, type.id(), scalar.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
      "attribute");
  const char* characters = text.c_str();
  check(H5Awrite(attribute.id(), type.id(), &characters), "attribute");
}

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

}  // namespace

void fail(const char* what) {
  bool is_short = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note_shortage, &is_short);
  if (is_short) {
    throw std::bad_alloc();
  }
  throw Error(what);
}

void describe(const Handle& dataset, std::string_view unit, std::string_view meaning) {
  add_text(dataset, "units", std::string(unit.empty() ? "1" : unit));
  add_text(dataset, "description", std::string(meaning));
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
  constexpr std::size_t kGrowth = 1U << 18U;
  static std::uint64_t count = 0;  // one that could not be closed keeps its name
  try {
    const Session session;
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
    check(H5Pset_fapl_core(access.id(), kGrowth, false), "memory driver");
    const Handle file(H5Fcreate(fmt::format("image-{}", ++count).c_str(), H5F_ACC_TRUNC,
                                H5P_DEFAULT, access.id()),
                      H5Fclose, "file");
    fill(file);
    return bytes_of(file);
  } catch (const Error& error) {
    throw StoreError(
        fmt::format("cannot write {}: the HDF5 library: {}", path.string(), error.what()));
  }
}

}  // namespace clca::store::hdf5

namespace clca::store {

void end_without_hdf5() {
  H5dont_atexit();
}

}  // namespace clca::store
