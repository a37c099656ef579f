#pragma once
// Ctrl-C and its kin.

#include <atomic>

namespace clca::cli {

/// From now on the first SIGINT, SIGTERM or SIGHUP only sets the returned value to its number; the
/// second ends the program at once. SIGHUP stays ignored where it was (nohup).
const std::atomic<int>& catch_stop_signals();
/// The signal that came since then; 0: none.
int stop_signal();

/// Call first. What cannot be written, to a file that may not grow or to a pipe that nobody reads
/// any more, is an error of that write, not the end; and child processes can be waited for.
void set_up_signals();

}  // namespace clca::cli
