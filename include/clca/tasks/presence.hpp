#pragma once
// Tells which ranks are there: each locks the byte of its number in a file that all can reach. The
// system releases the lock when the process ends, however it ends.

#include <filesystem>

namespace clca::tasks {

class Presence {
 public:
  /// Rank 0 makes the file if it is not there. Waits a few seconds if another process holds the
  /// byte. Throws std::system_error.
  Presence(const std::filesystem::path& file, int rank);
  ~Presence();
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;

  /// Whether another rank holds its byte.
  bool has(int rank) const;

 private:
  int file_ = -1;  // descriptor
};

}  // namespace clca::tasks
