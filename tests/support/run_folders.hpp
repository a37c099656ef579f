#pragma once
// Whether two runs have left the same.

#include <filesystem>
#include <string>

namespace clca::testing {

/// The first thing in which the folders of two runs differ, in words; empty when they are the same
/// but for what tells of time: the clock in run.json, the log, the checkpoints. Trajectories are
/// compared frame by frame, however they were cut into parts.
std::string difference_of_runs(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace clca::testing
