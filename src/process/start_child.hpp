#pragma once
// Starting another program in a child process.

#include <sys/types.h>

#include <string>
#include <vector>

#include "clca/process/program.hpp"

namespace clca::process {

/// Starts the file `arguments[0]` with standard input `input`. Throws ProcessError.
/// It inherits no other files than its standard streams, and ends when the calling thread ends.
pid_t start_child(const std::vector<std::string>& arguments, const ProgramOptions& options,
                  int input);

}  // namespace clca::process
