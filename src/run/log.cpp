#include "run/log.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>

#include "clca/store/file.hpp"
#include "clca/store/growing_file.hpp"

namespace clca::run {

namespace {

spdlog::logger open_logger(const std::filesystem::path& file, std::uint64_t kept) {
  const store::GrowingFile cut_off(file, kept);
  try {
    return {"clca", std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string())};
  } catch (const spdlog::spdlog_ex& error) {
    throw store::StoreError(fmt::format("cannot write {}: {}", file.string(), error.what()));
  }
}

}  // namespace

Log::Log(const std::filesystem::path& file, std::uint64_t kept, const RunEvents& events)
    : file_(file), logger_(open_logger(file, kept)), events_(events) {
  logger_.set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  logger_.flush_on(spdlog::level::info);
  // A log that cannot be written (a full disk) must not stop what can be.
  logger_.set_error_handler([](const std::string&) {});
}

std::uint64_t Log::bytes() const {
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(file_, unknown);
  return unknown ? 0 : bytes;
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
