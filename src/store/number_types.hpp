#pragma once
// HDF5 number types.

#include "store/hdf5_file.hpp"
#include "store/internal/hdf5.hpp"

namespace clca::store {

/// In the byte order of the machine, which HDF5 records.
template <Number T>
hid_t number_type() {
  if constexpr (std::same_as<T, std::uint8_t>) {
    return H5T_NATIVE_UINT8;
  } else if constexpr (std::same_as<T, std::uint16_t>) {
    return H5T_NATIVE_UINT16;
  } else if constexpr (std::same_as<T, std::uint32_t>) {
    return H5T_NATIVE_UINT32;
  } else if constexpr (std::same_as<T, std::uint64_t>) {
    return H5T_NATIVE_UINT64;
  } else if constexpr (std::same_as<T, std::int32_t>) {
    return H5T_NATIVE_INT32;
  } else {
    return H5T_NATIVE_DOUBLE;
  }
}

}  // namespace clca::store
