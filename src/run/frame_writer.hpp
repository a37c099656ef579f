#pragma once
// Encodes and writes pictures beside the simulation.

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include "clca/render/png.hpp"

namespace clca::run {

/// One thread of its own that takes pictures in the order they come. At most a few wait; then the
/// run waits too, so that memory stays bounded.
class FrameWriter {
 public:
  FrameWriter();
  /// Writes what is waiting.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Rethrows what went wrong with an earlier picture.
  void write(std::filesystem::path path, render::Image image, render::PngText text);
  /// Waits until everything is written. Rethrows likewise.
  void finish();

 private:
  struct Job {
    std::filesystem::path path;
    render::Image image;
    render::PngText text;
  };

  void work();
  void rethrow_failure();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool busy_ = false;
  bool closing_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: starts when the rest is there
};

}  // namespace clca::run
