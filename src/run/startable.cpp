#include "run/startable.hpp"

#include <fmt/format.h>

#include <utility>

#include "clca/parallel/team.hpp"

namespace clca::run {

RunOptions with_startable_threads(RunOptions options, const RunEvents& events) {
  const int wanted = std::exchange(options.threads, parallel::start_team(options.threads));
  if (options.threads < wanted && events.warning) {
    events.warning(fmt::format("only {} of {} threads can be started", options.threads, wanted));
  }
  return options;
}

}  // namespace clca::run
