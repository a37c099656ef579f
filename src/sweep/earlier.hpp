#pragma once
// Runs that an earlier sweep has left.

#include <filesystem>
#include <optional>

#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"

namespace clca::sweep {

/// The summary of the run in `folder` if it is a whole run of just this scene by this version of
/// the program, with its pictures: that of the final state, or all of them.
std::optional<store::RunSummary> earlier_run(const std::filesystem::path& folder,
                                             const scene::Scene& scene, bool all_pictures);

}  // namespace clca::sweep
