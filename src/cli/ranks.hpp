#pragma once
// The processes that mpirun has started together with this one.

#include <functional>
#include <memory>
#include <string>

#include "clca/tasks/ranks.hpp"

namespace clca::cli {

/// Calls `serve` on a rank that is not rank 0. Why it cannot serve goes to rank 0; that rank 0 is
/// lost is told here. Returns the exit code.
int serve_rank(tasks::Ranks& ranks, const std::function<void()>& serve);

/// Whether several processes can carry out a command together.
bool is_shared(const std::string& command);

/// All of them, in clca-mpi. In clca none: where mpirun has started it for a command that can be
/// shared, and without --part, clca-mpi takes its place. `arguments`: of the command line, ending
/// in a null pointer. Throws text::InputError if mpirun has started several and there is no
/// clca-mpi.
std::unique_ptr<tasks::Ranks> started_ranks(char** arguments);

}  // namespace clca::cli
