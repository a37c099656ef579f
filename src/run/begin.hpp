#pragma once
// The folder of a new run.

#include <string>
#include <vector>

#include "clca/run/run.hpp"

namespace clca::run {

/// A file that a run may write.
struct PlannedFile {
  std::string name;
  bool is_certain = false;  ///< it writes it whatever happens
};

/// Prepares the folder of `options` for a run that starts with `start` and writes `files` besides
/// those of every run; removes the files of an earlier run.
/// Throws UnfinishedRunError and store::StoreError before it changes anything.
store::RunFolder begin_run(const RunOptions& options, const RunEvents& events,
                           const store::Checkpoint& start, const std::vector<PlannedFile>& files);

}  // namespace clca::run
