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

/// Every `of`-th run of a plan, from the run `number` (from 1) on.
struct Part {
  std::size_t number = 1;
  std::size_t of = 1;
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
  /// That share the runs. Who calls execute() has to dismiss the others afterwards.
  tasks::Ranks* ranks = nullptr;
  /// If not zero, the sweep stops with complete files.
  const std::atomic<int>* stop = nullptr;
};

struct RunUnderWay {
  std::string name;
  run::Progress progress;
};

/// Progress of a sweep, in numbers of runs.
struct Progress {
  std::size_t runs = 0;    ///< of the part, if there is one
  std::size_t done = 0;    ///< with those of an earlier sweep
  std::size_t reused = 0;  ///< of those done, by an earlier sweep
  std::size_t failed = 0;
  std::size_t elsewhere = 0;   ///< under way in another process that is no rank of this sweep
  double runs_per_second = 0;  ///< over the runs of this sweep
  std::optional<double> seconds_left;
  std::vector<RunUnderWay> under_way;  ///< in this process, in the order of the plan
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

/// What the other ranks call in place of execute(), with the same plan: executes a share of the
/// runs. Throws tasks::StartError if they cannot begin together, as execute() does, too.
void serve(const Plan& plan, const Options& options);

}  // namespace clca::sweep
