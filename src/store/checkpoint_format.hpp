#pragma once
// The bytes of a checkpoint.
//
// Behind the checksum header stand entries, one after the other to the end of the file: four texts,
// and a column of numbers for each field of the run. An entry is
//
//     u8      type: 0 text, 1 u8, 2 u16, 3 u32, 4 u64, 5 i32, 6 f64, 7 i64
//     u16     length of the name
//     u64     count of bytes (of a text) or numbers
//     u64     length of the data
//     name
//     data    compressed by zlib: blocks of up to 65,536 numbers, of each block the lowest bytes of
//             all its numbers first, then the second bytes, and so on
//
// All numbers are little-endian, f64 as IEEE 754 has it.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/store/checkpoint.hpp"

namespace clca::store {

/// The whole file.
std::vector<std::uint8_t> checkpoint_bytes(const Checkpoint& checkpoint);

/// Throws std::runtime_error with the reason for data that checkpoint_bytes() does not produce, or
/// that needs more than `max_bytes` including the file; checked before allocation.
Checkpoint parse_checkpoint(std::span<const std::uint8_t> file, double max_bytes);

}  // namespace clca::store
