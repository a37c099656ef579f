#pragma once

namespace clca::cli {

enum class ExitCode : int {
  done = 0,
  failed = 1,  ///< a run failed, or pictures differ
  wrong_input = 2,
  signal_base = 128,  ///< plus the number of the signal that interrupted the run
};

}  // namespace clca::cli
