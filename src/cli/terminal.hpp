#pragma once
// The streams and signals of the program. All output goes through these functions.

#include <fmt/format.h>

#include <atomic>
#include <string_view>
#include <utility>

namespace clca::cli {

/// Call first. Reserves closed standard streams, so that no other file gets their number.
void occupy_closed_streams();

/// From then on only write_always() writes: of several processes one reports.
void silence_output() noexcept;

/// Writes to standard output. A failure is remembered for finish_output().
void write_out(std::string_view text) noexcept;
/// Writes to standard error; failures are ignored.
void write_error(std::string_view text) noexcept;
void write_always(std::string_view text) noexcept;

template <class... T>
void print_out(fmt::format_string<T...> format, T&&... values) {
  write_out(fmt::format(format, std::forward<T>(values)...));
}

template <class... T>
void print_error(fmt::format_string<T...> format, T&&... values) {
  write_error(fmt::format(format, std::forward<T>(values)...));
}

/// Call last: returns `code`, or an error code if that is 0 and standard output could not be
/// written. Reports it, unless the reader of a pipe has closed it.
int finish_output(int code) noexcept;

/// The first SIGINT, SIGTERM or SIGHUP only sets the returned value to its number; the second ends
/// the program. SIGHUP stays ignored if it was (nohup).
const std::atomic<int>& catch_stop_signals();
/// The signal that came since catch_stop_signals(); 0: none.
int stop_signal();

/// Call first. Writing to a closed pipe or beyond a size limit becomes an error of that write
/// instead of ending the program, and child processes can be waited for.
void set_up_signals();

}  // namespace clca::cli
