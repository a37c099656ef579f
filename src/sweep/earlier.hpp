#pragma once
// Runs of an earlier sweep.

#include <filesystem>
#include <optional>

#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"

namespace clca::sweep {

/// The summary of the run in `folder` if it is complete, of exactly this scene and program version,
/// and has its pictures: the final state, or all.
std::optional<store::RunSummary> earlier_run(const std::filesystem::path& folder,
                                             const scene::Scene& scene, bool all_pictures);

}  // namespace clca::sweep
