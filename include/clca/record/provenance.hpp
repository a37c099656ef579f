#pragma once
// Which program made a run.

#include <string>

#include "clca/store/summary.hpp"

namespace clca::record {

/// Version of the program, as in CMakeLists.txt.
std::string version();

/// A summary with version, compiler and build type filled in.
store::RunSummary provenance();

}  // namespace clca::record
