#pragma once
// A sweep as the command line says it.

#include <optional>
#include <string>
#include <vector>

#include "clca/sweep/sweep.hpp"
#include "cli/option_values.hpp"
#include "cli/scene_options.hpp"

namespace clca::cli {

struct SweepCommandOptions {
  SceneOptions scene;
  std::string seeds = "1..8";
  std::vector<std::string> variations;
  std::string folder;
  std::optional<sweep::Part> part;
  int jobs = machine_threads();
  bool collect_only = false;
  bool all_pictures = false;
  bool quiet = false;
  tasks::Ranks* ranks = nullptr;
};

/// Returns the exit code of `clca sweep`.
int run_sweep(const SweepCommandOptions& options);

}  // namespace clca::cli
