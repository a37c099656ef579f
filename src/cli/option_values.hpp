#pragma once
// Strict option values: CLI11 alone takes -1 as 2^64 - 1, 010 as 8 and nan as a number.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>

namespace clca::cli {

/// Digits without sign or leading zeros.
CLI::Validator whole_number(std::uint64_t least = 0,
                            std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
CLI::Validator finite_number();

/// `3/64`: the third of 64 parts.
CLI::Validator part_of_whole(std::uint64_t most);

/// For Option::transform: `90`, `30min` or `2h` into seconds.
CLI::Validator time_span();
/// For Option::transform: `4GiB` into bytes.
CLI::Validator byte_size();

}  // namespace clca::cli
