#pragma once
// The checkpoint content of a Boltzmann run.

#include <vector>

#include "clca/run/run.hpp"
#include "record/internal/gas_tables.hpp"

namespace clca::run {

/// Progress of a run.
struct GasCourse {
  std::uint64_t cases_ended = 0;  ///< of which log.txt tells already
  double wall_seconds = 0;
  std::uint64_t log_bytes = 0;
  std::vector<record::GasCase> cases;  ///< all that have begun, in the order of the scene

  CLCA_FIELDS(cases_ended, wall_seconds, log_bytes, cases);
};

/// As resume(), for a scene of the Boltzmann equation.
store::RunSummary resume_gas(SavedRun& saved, const RunOptions& options, const RunEvents& events);

inline constexpr const char* kSavedGases = "gases";

/// Loads the checkpoint for resuming with its scene. Gases at or on the way to a previous end go
/// back to the last time shared with the new one.
/// Throws store::StoreError for a checkpoint that no run of the scene can have saved, and for an
/// end that it cannot continue to.
GasCourse saved_course(const SavedRun& saved);

}  // namespace clca::run
