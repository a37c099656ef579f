#pragma once
// What happened during a run, line by line: to log.txt and to whoever listens.

#include <spdlog/logger.h>

#include <filesystem>
#include <string>

#include "clca/run/run.hpp"

namespace clca::run {

class Log {
 public:
  /// Throws store::StoreError when the file cannot be opened.
  Log(const std::filesystem::path& file, const RunEvents& events);

  void info(const std::string& line);
  void warning(const std::string& line);
  void error(const std::string& line);

 private:
  spdlog::logger logger_;
  const RunEvents& events_;
};

}  // namespace clca::run
