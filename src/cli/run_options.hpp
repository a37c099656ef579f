#pragma once
// What the commands that run a scene, or go on with one, have in common.

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
};

void add_run_options(CLI::App& command, RunCommonOptions& options);

using RunIt = std::function<store::RunSummary(const run::RunOptions&, const run::RunEvents&)>;

/// Lets `run_it` run, shows how it goes and what came out; `folder` is where. Returns the exit
/// code.
int show_run(const std::string& folder, const RunCommonOptions& options, const RunIt& run_it);

}  // namespace clca::cli
