#pragma once
// Where the time of steps goes.

namespace clca::automaton {

/// Wall-clock seconds, summed over steps.
struct Profile {
  double decide = 0;   ///< provisional directions
  double contest = 0;  ///< who wants the same sites
  double move = 0;  ///< moves that nobody contests and, on several threads, what each decides alone
  double turns = 0;  ///< all others, in order
};

}  // namespace clca::automaton
