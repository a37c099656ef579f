#pragma once
// The folder of a new run.

#include <string>
#include <vector>

#include "clca/run/run.hpp"

namespace clca::run {

/// Takes the folder of `options` over for a run that begins with `start`, and removes what an
/// earlier run has left there. `files` are names that the run may write. Throws UnfinishedRunError
/// and store::StoreError before anything is changed.
store::RunFolder begin_run(const RunOptions& options, const RunEvents& events,
                           const store::Checkpoint& start, const std::vector<std::string>& files);

}  // namespace clca::run
