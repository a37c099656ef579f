#pragma once
// What the child process does that reads an HDF5 file.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/process/child.hpp"
#include "store/hdf5_file.hpp"

namespace clca::store::hdf5 {

/// Before the bytes of each dataset: how many they are.
struct DatasetHeader {
  std::uint64_t rows = 0;        ///< or texts
  std::uint64_t item_bytes = 0;  ///< of a number or text
};

/// Sends these datasets of an HDF5 file, in their order: a header and the bytes of each. Throws
/// std::runtime_error before the first is sent where one is not as it should be, or where all of
/// them and once more the largest are more than `most_bytes`.
void send_datasets(std::span<const std::uint8_t> file, const std::vector<Hdf5Dataset>& datasets,
                   double most_bytes, const process::Child::Send& send);

}  // namespace clca::store::hdf5
