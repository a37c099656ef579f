#pragma once
// Rasterizes, encodes and writes pictures in the background.

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "clca/store/output_folder.hpp"
#include "run/frame_painter.hpp"

namespace clca::run {

/// Uses a thread of its own if possible and keeps the order of pictures. If a few are waiting the
/// caller waits too, so that memory stays bounded.
class FrameWriter {
 public:
  FrameWriter();
  /// Writes the waiting pictures.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Calls `picture` once, on that thread. Rethrows the error of an earlier picture or, without a
  /// thread, of this one.
  void write(store::OutputFolder folder, std::string name, std::function<Picture()> picture);
  /// Waits until everything is written. Rethrows likewise.
  void finish();

 private:
  struct Job {
    store::OutputFolder folder;
    std::string name;
    std::function<Picture()> picture;
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
