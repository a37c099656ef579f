#pragma once
// Sources: particles that enter during a run.

#include "clca/grains/occupancy.hpp"
#include "clca/grains/state.hpp"

namespace clca::grains {

struct SourceReport {
  /// Some open source will give more without anything else changing.
  bool waiting = false;
};

/// Lets every open source emit what is due and finds room. What finds none stays due, up to the
/// next step's share.
SourceReport run_sources(State& state, Occupancy& occupancy);

}  // namespace clca::grains
