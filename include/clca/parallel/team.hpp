#pragma once
// Threads of OpenMP regions and others, where the system limits their number.

namespace clca::parallel {

/// How many threads can exist, the calling one included: at least 1 and at most `wanted`. None is
/// left running. Throws std::invalid_argument unless `wanted` is positive.
int startable_threads(int wanted);

/// Starts `wanted` threads for the regions of the calling thread, the calling one included, or as
/// many as the system allows; OpenMP would end the program on failure. Regions of a child process
/// by fork have one thread. Returns the number of threads, at least 1. Throws std::invalid_argument
/// unless `wanted` is positive.
int start_team(int wanted);

}  // namespace clca::parallel
