#pragma once
// Starting the threads of OpenMP regions.

namespace clca::parallel {

/// Starts `wanted` threads, the calling one included, or as many as the system allows; OpenMP would
/// end the program on failure.
/// Returns the number of threads, at least 1. Throws std::invalid_argument unless `wanted` is
/// positive.
int start_team(int wanted);

}  // namespace clca::parallel
