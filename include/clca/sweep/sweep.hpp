#pragma once
// Executes the runs of a plan, several at a time, and writes a sweep folder:
//
//   sweep.json               the request
//   runs/KEY=VALUE,seed=N/   a run folder for each run
//   runs.csv                 a row for each run: values, seed, status, hash, measures, error
//   measures.csv             mean, standard deviation ... of each measure over the seeds
//   overview.png             final pictures, a row for each combination, a column for each seed
//
// Complete runs of an earlier sweep in the folder are reused, and runs that were stopped or killed
// go on. Parts of a sweep write run folders only, so that several may write at the same time, also
// from several machines. Other ranks write run folders, too, and rank 0 the rest.

#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "clca/run/run.hpp"
#include "clca/sweep/plan.hpp"
#include "clca/tasks/ranks.hpp"

namespace clca::sweep {

/// Every `count`-th run of a plan, from the run `number` (from 1) on.
struct Part {
  std::size_t number = 1;
  std::size_t count = 1;
};

struct Options {
  std::filesystem::path folder;
  std::optional<Part> part = {};  ///< only these runs, without tables and overview
  bool collect_only = false;      ///< tables over the runs that are there; runs nothing
  int jobs = 1;                   ///< runs at a time in this process, each with one thread
  /// All pictures of the scene; otherwise only the final state of the runs in the overview.
  bool all_pictures = false;
  /// Memory for what is read of a run that goes on, in bytes.
  double max_bytes = std::numeric_limits<double>::infinity();
  /// Processes that share the runs; the caller of execute() has to dismiss the others afterwards.
  tasks::Ranks* ranks = nullptr;
  /// If not zero, the sweep stops with complete files.
  const std::atomic<int>* stop_signal = nullptr;
};

struct RunUnderWay {
  std::string name;
  run::Progress progress;
};

/// Progress of a sweep, in numbers of runs.
struct Progress {
  std::size_t total_runs = 0;   ///< of the part, if there is one
  std::size_t done_runs = 0;    ///< with the reused ones
  std::size_t reused_runs = 0;  ///< done by an earlier sweep
  std::size_t failed_runs = 0;
  std::size_t runs_elsewhere = 0;  ///< under way in processes that are no ranks of this sweep
  double runs_per_second = 0;      ///< over the runs of this sweep
  std::optional<double> seconds_left;
  std::vector<RunUnderWay> running;  ///< in this process, in the order of the plan
};

/// Called from the thread that called execute(). `progress` may be empty; the others must not be:
/// by default they do nothing.
struct Events {
  std::function<void(const Progress&)> progress = {};  ///< some ten times a second
  std::function<void(const std::string&)> message = [](const std::string&) {};
  /// Failed runs among them.
  std::function<void(const std::string&)> warning = [](const std::string&) {};
};

/// Returns the final Progress: runs neither done nor failed are elsewhere, or were interrupted or
/// not started. A failed run does not stop the others.
/// Throws store::StoreError if something cannot be written, and scene::SceneError if no picture
/// can be drawn here.
Progress execute(const Plan& plan, const Options& options, const Events& events = {});

/// Executes a share of the runs. The ranks other than 0 call it in place of execute(), with the
/// same plan. Like that, throws tasks::StartError if the ranks cannot begin together.
void work_for_rank_0(const Plan& plan, const Options& options);

}  // namespace clca::sweep
