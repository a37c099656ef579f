#pragma once
// Resuming runs of the Boltzmann equation.

#include "clca/run/run.hpp"

namespace clca::run {

/// As resume(), for a scene of the Boltzmann equation.
store::RunSummary resume_gas(SavedRun& saved, const RunOptions& options, const RunEvents& events);

}  // namespace clca::run
