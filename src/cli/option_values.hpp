#pragma once
// Which values an option takes. CLI11 alone takes -1 as 2^64 - 1, 010 as 8 and nan as a number.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace clca::cli {

/// Digits without sign or leading zeros.
CLI::Validator whole_number(std::uint64_t least = 0,
                            std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// Pixels or, as `89mm`, a length on paper.
CLI::Validator length_of_figure();
CLI::Validator finite_number();
/// `0:5`, of which one may be left out: `:5`.
CLI::Validator limits_of_axis();
/// `3/64`: the third of 64 parts.
CLI::Validator part_of_whole(std::uint64_t most);
/// Any text, since the scene checks it; the words of this key are shown and completed.
CLI::Validator value_of_key(const std::string& key);
/// A key, `=` and what `form` (`KEY=VALUE`) says.
CLI::Validator assignment(const std::string& form);
/// `90`, `30min` or `2h` into seconds.
CLI::Validator time_span();
/// `4GiB` into bytes.
CLI::Validator byte_size();

/// Adds an option. `type`: what the help calls its values; empty: as their C++ type. `values`:
/// checks the values.
template <class T>
CLI::Option* add_option(CLI::App* command, const char* name, T& value, const char* type,
                        const std::string& what, const std::optional<CLI::Validator>& values = {}) {
  CLI::Option* option = command->add_option(name, value, what);
  if (*type != '\0') {
    option->type_name(type);
  }
  return values ? option->transform(*values) : option;
}

}  // namespace clca::cli
