#pragma once
// Timing of the phases of a step.

namespace clca::contact {

/// Wall-clock seconds, summed over steps; not measured for the reference.
struct Profile {
  double contacts = 0;    ///< finding touching pairs
  double order = 0;       ///< contacts put in order and into batches
  double motion = 0;      ///< bounces, gravity, and remainders by velocities
  double warm_start = 0;  ///< the impulses of the step before
  double sweeps = 0;
  double moves = 0;
};

}  // namespace clca::contact
