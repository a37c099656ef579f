#pragma once
// Run folders with a trajectory.

#include <filesystem>

#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"

namespace clca::testing {

/// Runs the scene into `folder` and leaves a trajectory there: a frame every so many steps of a
/// stage, as it begins and as it ends.
store::RunSummary run_and_store(const scene::Scene& scene, const std::filesystem::path& folder,
                                std::uint64_t every);

}  // namespace clca::testing
