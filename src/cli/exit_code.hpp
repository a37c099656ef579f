#pragma once

namespace clca::cli {

enum class ExitCode : int {
  done = 0,
  failed = 1,  ///< something failed, or pictures differ
  wrong_input = 2,
  time_is_up = 124,   ///< as of timeout(1)
  signal_base = 128,  ///< plus the number of the signal that interrupted the run
};

}  // namespace clca::cli
