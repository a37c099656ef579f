#pragma once
// Where the time of steps goes.

namespace clca::contact {

/// Seconds by the clock, added up over steps; not of the reference.
struct Profile {
  double contacts = 0;    ///< who touches whom
  double order = 0;       ///< contacts put in order and into batches
  double motion = 0;      ///< bounces, gravity, and remainders by velocities
  double warm_start = 0;  ///< the impulses of the step before
  double sweeps = 0;
  double moves = 0;
};

}  // namespace clca::contact
