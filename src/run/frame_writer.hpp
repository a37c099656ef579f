#pragma once
// Makes and writes files of pictures in the background.

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "clca/store/output_folder.hpp"

namespace clca::run {

/// Uses a thread of its own if possible and keeps the order of pictures. If a few are waiting the
/// caller waits too, so that memory stays bounded.
class FrameWriter {
 public:
  /// Pictures that wait at most.
  static constexpr int kMaxWaiting = 2;

  FrameWriter();
  /// Writes the waiting pictures.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Calls `bytes` once, on that thread. Rethrows the error of an earlier picture or, without a
  /// thread, of this one.
  void write(store::OutputFolder folder, std::string name,
             std::function<std::vector<std::uint8_t>()> bytes);
  /// Waits until everything is written. Rethrows likewise.
  void finish();

 private:
  struct Job {
    store::OutputFolder folder;
    std::string name;
    std::function<std::vector<std::uint8_t>()> bytes;
  };

  static void carry_out(const Job& job);
  void work();
  void rethrow_failure();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool busy_ = false;
  bool closing_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace clca::run
