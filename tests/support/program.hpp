#pragma once
// The program itself, called as a user calls it.

#include <map>
#include <string>
#include <vector>

namespace clca::testing {

struct ProgramResult {
  int code = 0;  ///< exit code, or minus the signal that ended the program
  std::string out;
  std::string err;
  double max_bytes = 0;  ///< of memory that it held at once
};

struct ProgramSetting {
  std::string folder = ".";                             ///< to run in
  std::map<std::string, std::string> environment = {};  ///< added to the present one
  int signal = 2;                                       ///< sent if one of the next two says when
  double signal_after = 0;                              ///< seconds, for kills at any moment
  /// When this file has the text: the summary of a run that is under way. Tables of a run grow at
  /// its checkpoints.
  std::string once = "";
  std::string once_has = "\"running\"";
  std::size_t file_size_limit = 0;  ///< bytes a file may have, as on a full disk; 0: no limit
  std::size_t memory_limit = 0;     ///< bytes of address space; 0: no limit
  std::string program = "";         ///< another one than clca, with its path
};

/// Runs `clca ARGUMENTS`, or another program, to its end.
ProgramResult run_program(const std::vector<std::string>& arguments,
                          const ProgramSetting& setting = {});

}  // namespace clca::testing
