#pragma once
// Develops, encodes and writes pictures beside the simulation.

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

/// One thread of its own, where it can be had, that takes pictures in the order they come. At most
/// a few wait; then the run waits too, so that memory stays bounded.
class FrameWriter {
 public:
  FrameWriter();
  /// Writes what is waiting.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// `picture` is called once, on that thread. Rethrows what went wrong with an earlier one, or,
  /// without a thread of its own, with this one.
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
