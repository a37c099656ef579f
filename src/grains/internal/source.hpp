#pragma once
// Sources: particles that enter during a run.

#include "clca/grains/state.hpp"
#include "grains/internal/occupancy_table.hpp"

namespace clca::grains {

struct SourceReport {
  /// Some open source will emit particles even if nothing else changes.
  bool waiting = false;
};

/// Emits the particles that are due from every open source, if they fit. Particles that do not fit
/// stay due, up to one step's share.
SourceReport run_sources(State& state, OccupancyTable& occupancy);

}  // namespace clca::grains
