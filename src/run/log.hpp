#pragma once
// What happened during a run, line by line: to log.txt and to whoever listens.

#include <spdlog/logger.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "clca/run/run.hpp"

namespace clca::run {

class Log {
 public:
  /// Keeps the first `kept` bytes of the file. Throws store::StoreError when it cannot be opened or
  /// has less.
  Log(const std::filesystem::path& file, std::uint64_t kept, const RunEvents& events);

  /// Bytes of the lines so far, all of which are in the file.
  std::uint64_t bytes() const;

  void info(const std::string& line);
  void warning(const std::string& line);
  void error(const std::string& line);

 private:
  std::filesystem::path file_;
  spdlog::logger logger_;
  const RunEvents& events_;
};

}  // namespace clca::run
