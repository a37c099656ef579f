#include "sweep/run_pool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "clca/run/run.hpp"
#include "clca/store/file.hpp"

namespace clca::sweep {

RunPool::RunPool(const Plan& plan, const Folder& folder, std::vector<std::size_t> runs,
                 const Options& options)
    : plan_(plan), folder_(folder), runs_(std::move(runs)), options_(options) {
  const std::lock_guard lock(mutex_);  // no thread begins before it is known how many they are
  try {
    threads_.reserve(wanted());
    while (threads_.size() < wanted()) {
      threads_.emplace_back([this] { work(); });
    }
  } catch (const std::exception&) {  // no more can be had
  }
  working_ = threads_.size();
}

RunPool::~RunPool() {
  stop();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

std::size_t RunPool::wanted() const {
  return std::min(runs_.size(), static_cast<std::size_t>(std::max(1, options_.jobs)));
}

std::vector<FinishedRun> RunPool::take_finished(std::chrono::milliseconds most) {
  if (threads_.empty() && next_ < runs_.size() && stop_ == 0) {
    return {execute_run(runs_[next_++])};
  }
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [this] { return !ended_.empty() || working_ == 0; });
  return std::exchange(ended_, {});
}

bool RunPool::finished() {
  const std::lock_guard lock(mutex_);
  const bool none_left = !threads_.empty() || next_ == runs_.size() || stop_ != 0;
  return working_ == 0 && ended_.empty() && none_left;
}

void RunPool::work() {
  std::unique_lock lock(mutex_);
  while (next_ < runs_.size() && stop_ == 0) {
    const std::size_t run = runs_[next_++];
    lock.unlock();
    FinishedRun one = execute_run(run);
    lock.lock();
    ended_.push_back(std::move(one));
    changed_.notify_all();
  }
  --working_;
  changed_.notify_all();
}

FinishedRun RunPool::execute_run(std::size_t run) const {
  FinishedRun one = {run, {}, {}, {}};
  one.result.status = Status::failed;
  try {
    std::error_code unknown;
    if (std::filesystem::is_symlink(folder_.run(plan_.name(run)), unknown)) {
      throw store::StoreError(fmt::format("cannot run in {}: it is a symbolic link",
                                          folder_.run(plan_.name(run)).string()));
    }
    run::RunEvents events;
    events.warning = [&one](const std::string& text) { one.warnings.push_back(text); };
    one.result.summary = run::run(plan_.scene(run),
                                  {.folder = folder_.run(plan_.name(run)),
                                   .threads = 1,
                                   .stop = threads_.empty() ? options_.stop : &stop_,
                                   .last_picture_only = !options_.all_pictures,
                                   .overwrite = true},
                                  events);
    one.result.status = one.result.summary.status == "done" ? Status::done : Status::interrupted;
  } catch (const store::StoreError& error) {
    one.result.error = error.what();
    one.store_error = error.what();
  } catch (const std::bad_alloc&) {
    one.result.error = "out of memory";
  } catch (const std::exception& error) {
    one.result.error = error.what();
  }
  return one;
}

}  // namespace clca::sweep
