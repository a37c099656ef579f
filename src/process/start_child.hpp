#pragma once
// A child process: another program in place of a copy of this one.

#include <sys/types.h>

#include <string>
#include <vector>

#include "clca/process/program.hpp"

namespace clca::process {

/// Starts the file `arguments[0]` with `input` as its standard input. It inherits no other file
/// than its standard streams, and ends when the thread that calls this does. Throws ProcessError.
pid_t start_child(const std::vector<std::string>& arguments, const Setting& setting, int input);

}  // namespace clca::process
