#include "drawing/frame_writer.hpp"

#include <system_error>
#include <utility>

namespace clca::drawing {

FrameWriter::FrameWriter() {
  try {
    thread_ = std::thread([this] { work(); });
  } catch (const std::system_error&) {
    // Without a further thread the caller does it.
  }
}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void FrameWriter::add(std::function<void()> job) {
  if (!thread_.joinable()) {
    job();
    return;
  }
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.size() < std::size_t{kMaxWaiting} || failure_; });
  rethrow_failure();
  jobs_.push_back(std::move(job));
  changed_.notify_all();
}

void FrameWriter::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return (jobs_.empty() && !busy_) || failure_; });
  rethrow_failure();
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closing_ || !jobs_.empty(); });
    if (jobs_.empty() || failure_) {
      return;
    }
    const std::function<void()> job = std::move(jobs_.front());
    jobs_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      job();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    failure_ = failure;
    changed_.notify_all();
  }
}

void FrameWriter::rethrow_failure() {
  if (failure_) {
    std::rethrow_exception(failure_);
  }
}

}  // namespace clca::drawing
