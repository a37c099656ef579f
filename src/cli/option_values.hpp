#pragma once
// What the values of options may be. CLI11 alone takes -1 for 2^64 - 1, 010 for 8 and nan for a
// number.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>

namespace clca::cli {

/// Digits, without a sign or a superfluous zero in front.
CLI::Validator whole_number(std::uint64_t least = 0,
                            std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
CLI::Validator finite_number();

/// For Option::transform: `90`, `30min` or `2h` into seconds.
CLI::Validator time_span();
/// For Option::transform: `4GiB` into bytes.
CLI::Validator byte_size();

}  // namespace clca::cli
