#pragma once
// Runs everything that a plan has, several runs at a time, and leaves a sweep folder:
//
//   sweep.json               what was asked
//   runs/KEY=VALUE,seed=N/   a run folder for each run
//   runs.csv                 a row for each run: values, seed, status, hash, measures, error
//   measures.csv             mean, standard deviation ... of each measure over the seeds
//   overview.png             final pictures, a row for each combination, a column for each seed
//
// Runs that an earlier sweep has left whole in the folder are taken as they are.

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "clca/sweep/plan.hpp"

namespace clca::sweep {

struct Options {
  std::filesystem::path folder;
  int jobs = 1;  ///< runs at a time, each with one thread
  /// All pictures that the scene asks for; otherwise that of the final state only.
  bool all_pictures = false;
  /// When it is not zero the sweep ends with what it has, written whole.
  const std::atomic<int>* stop = nullptr;
};

/// How a sweep is going; numbers of runs.
struct Progress {
  std::size_t runs = 0;
  std::size_t done = 0;    ///< with those of an earlier sweep
  std::size_t reused = 0;  ///< those
  std::size_t failed = 0;
  double runs_per_second = 0;  ///< over the runs of this sweep
  std::optional<double> seconds_left;
};

/// All optional; called from the thread that called execute().
struct Events {
  std::function<void(const Progress&)> progress = {};  ///< some ten times a second
  std::function<void(const std::string&)> message = {};
  std::function<void(const std::string&)> warning = {};  ///< failed runs among them
};

/// The last Progress says how it has ended: runs that are neither done nor failed were interrupted
/// or not begun. A run that fails does not stop the others. Throws store::StoreError when
/// something cannot be written, and run::ScenePlaceError when no picture can be drawn here.
Progress execute(const Plan& plan, const Options& options, const Events& events = {});

}  // namespace clca::sweep
