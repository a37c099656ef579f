#pragma once
// Ctrl-C and its kin.

#include <atomic>

namespace clca::cli {

/// From now on the first SIGINT or SIGTERM only sets the returned value to its number; the second
/// ends the program at once.
const std::atomic<int>& catch_stop_signals();

/// A file that would pass the limit on its size is an error of that write, not the end.
void ignore_file_size_signal();

}  // namespace clca::cli
