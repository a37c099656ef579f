#include "run/frame_writer.hpp"

#include <system_error>
#include <utility>

namespace clca::run {

FrameWriter::FrameWriter() {
  try {
    thread_ = std::thread([this] { work(); });
  } catch (const std::system_error&) {
    // Without a further thread the caller writes the picture.
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

void FrameWriter::write(store::OutputFolder folder, std::string name,
                        std::function<std::vector<std::uint8_t>()> bytes) {
  Job job = {std::move(folder), std::move(name), std::move(bytes)};
  if (!thread_.joinable()) {
    carry_out(job);
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

void FrameWriter::carry_out(const Job& job) {
  job.folder.write(job.name, job.bytes());
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closing_ || !jobs_.empty(); });
    if (jobs_.empty() || failure_) {
      return;
    }
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      carry_out(job);
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

}  // namespace clca::run
