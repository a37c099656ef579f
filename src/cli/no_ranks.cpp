// Without MPI: hands over to clca-mpi where mpirun has started this program.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <system_error>

#include "clca/text/read.hpp"
#include "cli/ranks.hpp"

namespace clca::cli {

namespace {

/// The first of these variables that is there.
std::optional<std::string> variable(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const char* text = std::getenv(name)) {  // NOLINT(concurrency-mt-unsafe): nobody sets them
      return text;
    }
  }
  return std::nullopt;
}

/// With --part each process does a part of its own.
bool has_part(char** arguments) {
  for (; *arguments != nullptr; ++arguments) {
    if (std::string_view(*arguments).starts_with("--part")) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::unique_ptr<tasks::Ranks> start_ranks(char** arguments) {
  // Open MPI, Slurm with PMIx, MPICH and Intel MPI.
  const auto rank = variable({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"});
  const auto size = variable({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"});
  if (arguments[0] == nullptr || arguments[1] == nullptr || !can_use_ranks(arguments[1]) || !rank ||
      !size || *size == "1" || has_part(arguments)) {
    return nullptr;
  }
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string other = (self.parent_path() / "clca-mpi").string();
  if (!error) {
    ::execv(other.c_str(), arguments);
  }
  throw text::InputError(*rank != "0"
                             ? ""
                             : fmt::format("{} processes have been started together, which "
                                           "needs clca-mpi beside {}: build clca where "
                                           "MPI is installed, or use --part",
                                           *size, self.string()));
}

void end_all_ranks(int /*code*/) {}  // there are none

}  // namespace clca::cli
