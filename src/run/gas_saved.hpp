#pragma once
// What a run of the Boltzmann equation keeps in its checkpoint.

#include <vector>

#include "clca/run/run.hpp"
#include "run/gas_tables.hpp"

namespace clca::run {

/// How far a run has come.
struct GasCourse {
  std::uint64_t cases_ended = 0;  ///< of which log.txt tells already
  double wall_seconds = 0;
  std::uint64_t log_bytes = 0;
  std::vector<GasCase> cases;  ///< all that have begun, in the order of the scene

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("cases_ended", &GasCourse::cases_ended),
                           field("wall_seconds", &GasCourse::wall_seconds),
                           field("log_bytes", &GasCourse::log_bytes),
                           field("cases", &GasCourse::cases));
  }
};

inline constexpr const char* kSavedGases = "gases";

/// The course that `saved` has in its checkpoint, so that it can go on with its scene: gases that
/// came to the end which the scene had then, or are on the way to it, stand where they last were
/// as in a run with the end that it has now. Throws store::StoreError for a checkpoint that no run
/// of the scene has saved, and where an end is asked for to which it cannot go on.
GasCourse saved_course(const SavedRun& saved);

}  // namespace clca::run
