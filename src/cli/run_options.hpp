#pragma once
// Options of the commands that run or resume a scene.

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>

#include "clca/run/run.hpp"
#include "cli/scene_options.hpp"

namespace clca::cli {

struct RunCommonOptions {
  int threads = machine_threads();
  std::optional<double> time_limit;  ///< seconds
  bool reference = false;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
};

void add_run_options(CLI::App& command, RunCommonOptions& options);

using RunIt = std::function<store::RunSummary(const run::RunOptions&, const run::RunEvents&)>;

/// Calls `run_it`, shows progress and results; `folder` is the run folder. Returns the exit code.
int show_run(const std::string& folder, const RunCommonOptions& options, const RunIt& run_it);

}  // namespace clca::cli
