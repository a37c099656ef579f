#include "store/hdf5.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <new>

#include "clca/process/child.hpp"
#include "clca/store/file.hpp"

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

void send_image(const std::function<void(const Handle& file)>& fill,
                const process::Child::Send& send) {
  constexpr std::size_t kGrowth = 1U << 20U;
  begin();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "file access");
  check(H5Pset_fapl_core(access.id(), kGrowth, false), "memory driver");
  const Handle file(H5Fcreate("image", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "file");
  fill(file);
  const std::vector<std::uint8_t> bytes = bytes_of(file);
  const std::uint64_t size = bytes.size();
  send({reinterpret_cast<const std::uint8_t*>(&size), sizeof size});
  send(bytes);
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

void begin() {
  static const herr_t kFirst = H5dont_atexit();  // may be called once
  check(kFirst, "begin");
  check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr), "errors");
  check(H5PLset_loading_state(0), "plugins");
}

std::vector<std::uint8_t> image(const std::filesystem::path& path,
                                const std::function<void(const Handle& file)>& fill) {
  try {
    constexpr process::ChildLimits kLimits = {.memory_bytes = 1e18, .cpu_seconds = 600};
    process::Child child([&](const process::Child::Send& send) { send_image(fill, send); },
                         kLimits);
    std::array<std::uint8_t, sizeof(std::uint64_t)> size_bytes = {};
    child.receive(size_bytes);
    std::uint64_t size = 0;
    std::memcpy(&size, size_bytes.data(), sizeof size);
    std::vector<std::uint8_t> bytes(size);
    child.receive(bytes);
    child.finish();
    return bytes;
  } catch (const process::ProcessError& error) {
    throw StoreError(
        fmt::format("cannot write {}: the HDF5 library: {}", path.string(), error.what()));
  }
}

}  // namespace clca::store::hdf5
