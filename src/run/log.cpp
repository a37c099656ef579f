#include "run/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>

#include "clca/store/file.hpp"

namespace clca::run {

namespace {

spdlog::logger open_logger(const std::filesystem::path& file) {
  try {
    return {"clca", std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string(), true)};
  } catch (const spdlog::spdlog_ex& error) {
    throw store::StoreError(fmt::format("cannot write {}: {}", file.string(), error.what()));
  }
}

}  // namespace

Log::Log(const std::filesystem::path& file, const RunEvents& events)
    : logger_(open_logger(file)), events_(events) {
  logger_.set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  logger_.flush_on(spdlog::level::info);
  // A log that cannot be written (a full disk) must not stop what can be.
  logger_.set_error_handler([](const std::string&) {});
}

void Log::info(const std::string& line) {
  logger_.info(line);
  if (events_.message) {
    events_.message(line);
  }
}

void Log::warning(const std::string& line) {
  logger_.warn(line);
  if (events_.warning) {
    events_.warning(line);
  }
}

void Log::error(const std::string& line) {
  logger_.error(line);
}

}  // namespace clca::run
