#pragma once
// Ctrl-C and its kin.

#include <atomic>

namespace clca::cli {

/// From now on the first SIGINT or SIGTERM only sets the returned value to its number; the second
/// ends the program at once.
const std::atomic<int>& catch_stop_signals();

/// What cannot be written, to a file that may not grow or to a pipe that nobody reads any more, is
/// an error of that write, not the end.
void ignore_write_signals();

}  // namespace clca::cli
