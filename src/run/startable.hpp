#pragma once
// If fewer threads can be started, the run uses these: the result does not depend on them.

#include "clca/run/run.hpp"

namespace clca::run {

/// The options with as many threads as could be started. Warns if fewer than requested.
RunOptions with_threads(RunOptions options, int startable, const RunEvents& events);

}  // namespace clca::run
