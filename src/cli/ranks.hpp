#pragma once
// The processes that mpirun has started together with this one.

#include <memory>
#include <string_view>

#include "clca/tasks/ranks.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

inline bool can_use_ranks(std::string_view command) {
  return command == "sweep" || command == "boltzmann" || command == "resume";
}

/// The signal that has stopped this process or, as rank 0 knows, another one; 0: none has.
inline int stop_signal_of(const tasks::Ranks* ranks) {
  const int own = stop_signal();
  return own != 0 || ranks == nullptr ? own : ranks->stop_signal();
}

/// clca-mpi: starts MPI and returns all ranks. clca: returns none; but where mpirun has started it
/// for a command that can be shared, and without --part, it becomes clca-mpi. `arguments`: of the
/// command line, ending in a null pointer. Throws text::InputError if mpirun has started several
/// and there is no clca-mpi.
std::unique_ptr<tasks::Ranks> start_ranks(char** arguments);

/// Ends this process and all others at once, with an exit code.
void end_all_ranks(int code);

}  // namespace clca::cli
