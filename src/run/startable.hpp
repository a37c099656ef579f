#pragma once
// If fewer threads can be started, the run uses these: the result does not depend on them.

#include "clca/run/run.hpp"

namespace clca::run {

/// The options with as many threads as can be started, for parallel regions of the calling thread.
/// Warns if fewer than requested.
/// Throws std::invalid_argument unless the requested number is positive.
RunOptions with_startable_threads(RunOptions options, const RunEvents& events);

}  // namespace clca::run
