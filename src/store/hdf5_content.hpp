#pragma once
// The work of the child process that reads an HDF5 file.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/process/child.hpp"
#include "store/hdf5_file.hpp"

namespace clca::store::hdf5 {

/// Sent before each dataset: its size.
struct DatasetHeader {
  std::uint64_t rows = 0;        ///< or texts
  std::uint64_t item_bytes = 0;  ///< of a number or text
};

/// Sends these datasets of an HDF5 file in order: header and bytes of each.
/// Before sending, throws std::runtime_error if a dataset is invalid, or if all of them plus the
/// largest again exceed `max_bytes`.
void send_datasets(std::span<const std::uint8_t> file, const std::vector<Hdf5Dataset>& datasets,
                   double max_bytes, const process::Child::Send& send);

}  // namespace clca::store::hdf5
