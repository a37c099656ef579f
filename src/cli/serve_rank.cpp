#include <fmt/format.h>

#include <exception>

#include "clca/tasks/leader.hpp"
#include "cli/exit_code.hpp"
#include "cli/ranks.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

bool is_shared(const std::string& command) {
  return command == "sweep" || command == "boltzmann" || command == "resume";
}

int serve_rank(tasks::Ranks& ranks, const std::function<void()>& serve) {
  try {
    serve();
  } catch (const tasks::LeaderLostError& error) {
    write_always(fmt::format("clca: error: {}\n", error.what()));
    return static_cast<int>(ExitCode::failed);
  } catch (const std::exception& error) {
    tasks::refuse_to_serve(ranks, error.what());
  }
  return static_cast<int>(ExitCode::done);
}

}  // namespace clca::cli
