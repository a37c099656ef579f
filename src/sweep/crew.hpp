#pragma once
// Threads that carry out runs, one run at a time each.

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

/// A run that has ended.
struct Ended {
  std::size_t run = 0;
  Result result;
  std::vector<std::string> warnings;
  std::string store_error;  ///< something could not be written; empty: all was
};

class Crew {
 public:
  /// Begins to carry out `runs` of the plan in this order, as many at a time as the options say, or
  /// as threads can be started. Where there is none ended() carries them out, one after the other.
  /// What it refers to must outlive this object.
  Crew(const Plan& plan, const Folder& folder, std::vector<std::size_t> runs,
       const Options& options);
  /// Interrupts what is still going on.
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Runs at a time: those asked for, and those there are.
  std::size_t wanted() const;
  std::size_t at_a_time() const { return std::max<std::size_t>(threads_.size(), 1); }
  /// Interrupts the runs; no more are begun.
  void stop() { stop_ = 1; }
  /// Waits until runs have ended, at most for `most`, and hands them over.
  std::vector<Ended> ended(std::chrono::milliseconds most);
  /// True when nothing more will end.
  bool finished();

 private:
  void work();
  Ended carried_out(std::size_t run) const;

  const Plan& plan_;
  const Folder& folder_;
  std::vector<std::size_t> runs_;
  const Options& options_;
  std::atomic<int> stop_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0;     // of runs_
  std::size_t working_ = 0;  // threads
  std::vector<Ended> ended_;
  std::vector<std::thread> threads_;
};

}  // namespace clca::sweep
