#pragma once
// The threads that parallel regions of OpenMP will use.

namespace clca::parallel {

/// Starts the threads for parallel regions of the calling thread, `wanted` with this one, or as
/// many as can be had: OpenMP itself ends the program when one cannot be started. Returns how
/// many, at least 1. Throws std::invalid_argument unless `wanted` is positive.
int start_team(int wanted);

}  // namespace clca::parallel
