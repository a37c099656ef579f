#include "store/hdf5.hpp"

#include <atomic>
#include <cstdint>

namespace clca::store::hdf5 {

namespace {

std::recursive_mutex& one_at_a_time() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

std::string name_in_memory() {
  static std::atomic<std::uint64_t> count = 0;
  return "clca-" + std::to_string(++count);
}

Session::Session() : lock_(one_at_a_time()) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // of this thread
}

}  // namespace clca::store::hdf5
