#pragma once
// Which program made a run.

#include "clca/store/summary.hpp"

namespace clca::run {

/// A summary with version, compiler and build type filled in.
store::RunSummary provenance();

}  // namespace clca::run
