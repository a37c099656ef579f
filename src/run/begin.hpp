#pragma once
// The folder of a new run.

#include <set>
#include <string>
#include <vector>

#include "clca/run/run.hpp"

namespace clca::run {

/// Prepares the folder of `options` for a run that starts with `start`, and removes the files of an
/// earlier run. `files`: names that the run may write; `planned`: those that it will write for
/// certain, besides those of every run.
/// Throws UnfinishedRunError and store::StoreError before it changes anything.
store::RunFolder begin_run(const RunOptions& options, const RunEvents& events,
                           const store::Checkpoint& start, const std::vector<std::string>& files,
                           const std::set<std::string>& planned = {});

}  // namespace clca::run
