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

/// Says whether a rank has ended: its lock was there and is missing at two looks in a row. What it
/// sent before may arrive between them.
class Watch {
 public:
  /// `was_there`: at an earlier look.
  explicit Watch(bool was_there = false) : was_there_(was_there) {}
  bool has_ended(bool is_there) {
    const bool twice = was_missing_ && !is_there;
    was_missing_ = was_there_ && !is_there;
    was_there_ |= is_there;
    return twice;
  }

 private:
  bool was_there_;
  bool was_missing_ = false;
};

}  // namespace clca::tasks
