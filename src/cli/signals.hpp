#pragma once
// Handling of Ctrl-C and similar signals.

#include <atomic>

namespace clca::cli {

/// The first SIGINT, SIGTERM or SIGHUP only sets the returned value to its number; the second ends
/// the program. SIGHUP stays ignored if it was (nohup).
const std::atomic<int>& catch_stop_signals();
/// The signal that came since then; 0: none.
int stop_signal();

/// Call first. Writing to a closed pipe or beyond a size limit becomes an error of that write
/// instead of ending the program, and child processes can be waited for.
void set_up_signals();

}  // namespace clca::cli
