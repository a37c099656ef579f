#pragma once
// A case, measured: its variants take turns, so that other work on the machine meets all of them.

#include <cstdint>
#include <vector>

#include "cases.hpp"

namespace clca::bench {

struct Effort {
  int threads = 1;                 ///< 1 to so many
  double seconds = 1;              ///< for each variant; there are at least two runs
  std::uint64_t max_updates = 0;   ///< of a run: particles x steps
  std::size_t max_unsleeping = 0;  ///< particles, with which sleeping is turned off, too
};

/// All runs of one variant.
struct Measurement {
  Case a_case = Case::falling;
  std::size_t particles = 0;
  Variant variant = {};
  std::vector<Run> runs = {};        ///< they all did the same
  std::vector<Sample> samples = {};  ///< of steps; of all variants with these ties
  double speedup = 1;                ///< the best run against the best on one thread with sleeping

  /// Seconds a step.
  double best() const { return step_seconds().front(); }
  double median() const;
  double worst() const { return step_seconds().back(); }
  /// Of the best run: other work on the machine only adds.
  const Work& work() const;

 private:
  std::vector<double> step_seconds() const;  // of each run, ascending
};

/// Throws std::runtime_error when variants with the same ties come to different states.
std::vector<Measurement> measure(Case a_case, const grains::State& start, const Effort& effort);

}  // namespace clca::bench
