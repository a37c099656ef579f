#pragma once
// A pool of threads that execute runs, one run per thread.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "clca/sweep/plan.hpp"
#include "clca/sweep/sweep.hpp"
#include "sweep/folder.hpp"
#include "sweep/result.hpp"

namespace clca::sweep {

/// A finished run.
struct FinishedRun {
  std::size_t run = 0;
  Result result;
  std::vector<std::string> warnings;
  std::string store_error;  ///< something could not be written; empty: all was
};

class RunPool {
 public:
  /// Starts executing `runs` of the plan in order, as many at a time as the options say or threads
  /// can be started. Without threads take_finished() executes them one by one.
  /// All references must outlive this object.
  RunPool(const Plan& plan, const Folder& folder, std::vector<std::size_t> runs,
          const Options& options);
  /// Interrupts the running runs.
  ~RunPool();
  RunPool(const RunPool&) = delete;
  RunPool& operator=(const RunPool&) = delete;

  /// Runs at a time: requested, and actual.
  std::size_t wanted() const;
  std::size_t at_a_time() const { return std::max<std::size_t>(threads_.size(), 1); }
  /// Interrupts the runs and starts no more.
  void stop() { stop_ = 1; }
  /// Waits at most `most` for finished runs and returns them.
  std::vector<FinishedRun> take_finished(std::chrono::milliseconds most);
  /// True if no run is left.
  bool finished();

 private:
  void work();
  FinishedRun execute_run(std::size_t run) const;

  const Plan& plan_;
  const Folder& folder_;
  std::vector<std::size_t> runs_;
  const Options& options_;
  std::atomic<int> stop_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0;     // of runs_
  std::size_t working_ = 0;  // threads
  std::vector<FinishedRun> ended_;
  std::vector<std::thread> threads_;
};

}  // namespace clca::sweep
