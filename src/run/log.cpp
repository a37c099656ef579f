#include "run/log.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>

#include "clca/store/file.hpp"

namespace clca::run {

void Log::append(const char* level, const std::string& line) {
  using std::chrono::system_clock;
  const system_clock::time_point now = system_clock::now();
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()) %
      std::chrono::seconds(1);
  try {
    file_.append(fmt::format("{:%Y-%m-%d %H:%M:%S}.{:03} {}: {}\n",
                             fmt::localtime(system_clock::to_time_t(now)), milliseconds.count(),
                             level, line));
  } catch (const store::StoreError&) {  // see above
  }
}

void Log::info(const std::string& line) {
  append("info", line);
  if (events_.message) {
    events_.message(line);
  }
}

void Log::warning(const std::string& line) {
  append("warning", line);
  if (events_.warning) {
    events_.warning(line);
  }
}

void Log::error(const std::string& line) {
  append("error", line);
}

}  // namespace clca::run
