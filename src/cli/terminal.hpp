#pragma once
// What the program prints. All of it goes through here.

#include <fmt/format.h>

#include <exception>
#include <string_view>
#include <utility>

namespace clca::cli {

/// Call first. Where standard input, output or error is closed, no file that is opened later gets
/// its number: writing there fails instead of ending up in that file.
void occupy_closed_streams();

/// Writes to standard output. A failure is remembered for end_output().
void write_out(std::string_view text) noexcept;
/// Writes to standard error. Where that fails there is nobody to be told.
void write_error(std::string_view text) noexcept;

template <class... T>
void print_out(fmt::format_string<T...> format, T&&... values) {
  write_out(fmt::format(format, std::forward<T>(values)...));
}

template <class... T>
void print_error(fmt::format_string<T...> format, T&&... values) {
  write_error(fmt::format(format, std::forward<T>(values)...));
}

/// One line on standard error: `clca: error: MESSAGE`, control characters escaped.
void complain(const std::exception& error);

/// Call last: the exit code of the program, `code` unless that is 0 and something could not be
/// written to standard output. Says so, except where the reader of a pipe has had enough.
int end_output(int code) noexcept;

}  // namespace clca::cli
