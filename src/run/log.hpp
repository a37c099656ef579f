#pragma once
// What happened during a run, line by line: to log.txt and to whoever listens.

#include <cstdint>
#include <string>

#include "clca/run/run.hpp"
#include "clca/store/growing_file.hpp"

namespace clca::run {

/// A log that cannot be written (a full disk) does not stop what can be.
class Log {
 public:
  /// Keeps the first `kept` bytes of the file. Throws store::StoreError when it has less.
  Log(const store::RunFolder& folder, std::uint64_t kept, const RunEvents& events)
      : file_(folder.files(), store::kLogFile, kept), events_(events) {}

  /// Bytes of the lines so far, all of which are in the file.
  std::uint64_t bytes() const { return file_.bytes(); }

  void info(const std::string& line);
  void warning(const std::string& line);
  void error(const std::string& line);

 private:
  void append(const char* level, const std::string& line);

  store::GrowingFile file_;
  const RunEvents& events_;
};

}  // namespace clca::run
