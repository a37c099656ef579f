#pragma once
// Threads that cannot be started are no reason not to run: the result does not depend on them.

#include "clca/run/run.hpp"

namespace clca::run {

/// The same options with as many threads as can be started; they are started then, for the parallel
/// regions of the calling thread. One warning where they are fewer than asked for. Throws
/// std::invalid_argument unless the number asked for is positive.
RunOptions with_startable_threads(RunOptions options, const RunEvents& events);

}  // namespace clca::run
