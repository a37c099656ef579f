#pragma once
// Options of the commands that run or resume a scene.

#include <functional>
#include <optional>

#include "clca/run/run.hpp"
#include "cli/scene_options.hpp"

namespace clca::cli {

struct RunCommonOptions {
  std::optional<int> threads;
  std::optional<double> time_limit;  ///< seconds
  bool reference = false;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  tasks::Ranks* ranks = nullptr;
};

/// As asked for. Otherwise one for grains, since it depends on the machine whether several are
/// faster or slower; for a gas all of the machine, or one where ranks share it.
int threads_of(const RunCommonOptions& options, const scene::Scene& scene);
int threads_of(const RunCommonOptions& options, const scene::BoltzmannScene& scene);
/// For a gas: those of all ranks on this machine, which share its memory.
int threads_here(const RunCommonOptions& options);
void add_run_options(Command& command, RunCommonOptions& options);

using RunIt = std::function<store::RunSummary(const run::RunOptions&, const run::RunEvents&)>;

/// Advances gases for rank 0, as another rank. Returns the exit code.
int serve_gases(const RunCommonOptions& options);

/// Prints `run.json` of a run folder.
void print_summary(const std::filesystem::path& folder);

/// Calls `run_it`, shows progress and results; `folder` is the run folder. Returns the exit code.
int show_run(const std::string& folder, const RunCommonOptions& options, int threads,
             const RunIt& run_it);

}  // namespace clca::cli
