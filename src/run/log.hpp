#pragma once
// The log of a run: log.txt and a callback.

#include <cstdint>
#include <string>

#include "clca/run/run.hpp"
#include "clca/store/output_folder.hpp"

namespace clca::run {

/// Failure to write (full disk) does not stop the run.
class Log {
 public:
  /// Keeps the first `kept` bytes of the file. Throws store::StoreError if it has less.
  Log(const store::RunFolder& folder, std::uint64_t kept, const RunEvents& events)
      : file_(folder.files(), store::kLogFile, kept), events_(events) {}

  /// Bytes written so far.
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
