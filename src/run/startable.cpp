#include "run/startable.hpp"

#include <fmt/format.h>

#include <utility>

namespace clca::run {

RunOptions with_threads(RunOptions options, int startable, const RunEvents& events) {
  const int wanted = std::exchange(options.threads, startable);
  if (options.threads < wanted && events.warning) {
    events.warning(fmt::format("only {} of {} threads can be started", options.threads, wanted));
  }
  return options;
}

}  // namespace clca::run
