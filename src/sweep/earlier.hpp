#pragma once
// Runs of an earlier sweep.

#include <filesystem>
#include <optional>

#include "clca/run/run.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"

namespace clca::sweep {

/// A run that was once done.
struct EarlierRun {
  store::RunSummary summary;
  /// It is of exactly this scene and program version, and has the pictures that are wanted.
  bool is_whole = false;
};

/// The run in `folder`, if one was done there.
std::optional<EarlierRun> earlier_run(const std::filesystem::path& folder,
                                      const scene::Scene& scene, run::WantedPictures pictures);

/// Whether a run of exactly this scene and program version was stopped or killed, or has failed, in
/// `folder`.
bool can_go_on(const std::filesystem::path& folder, const scene::Scene& scene);

}  // namespace clca::sweep
