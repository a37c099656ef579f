#pragma once
// Run folders with a trajectory.

#include <filesystem>
#include <string>

namespace clca::testing {

/// Runs the scene text, each stage for `steps` steps or until it settles, with a frame at the begin
/// and the end of each stage and every `every` steps; leaves scene.yaml, run.json and the
/// trajectory.
void record(const std::string& scene_text, const std::filesystem::path& folder, int steps,
            int every);

}  // namespace clca::testing
