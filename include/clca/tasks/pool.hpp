#pragma once
// Independent tasks, carried out by threads of this process and by other ranks.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "clca/tasks/leader.hpp"
#include "clca/tasks/threads.hpp"

namespace clca::tasks {

template <class Result>
class Pool {
 public:
  struct Work {
    /// In a thread of this process, until `stop` is not zero; several are called at once.
    std::function<Result(std::size_t task, const std::atomic<int>& stop)> carry_out;
    /// For another rank: what it needs, and the result from what it sends back.
    std::function<Bytes(std::size_t task)> request = {};
    std::function<Result(std::size_t task, const Bytes& answer)> result = {};
    /// Each thread of this process begins with it.
    std::function<void()> begin = {};
  };
  struct Finished {
    std::size_t task = 0;
    Result result;
  };

  /// `threads`: tasks at a time in this process. `leader`: of the other ranks, if there are any.
  /// `stop`: once it is not zero, all tasks are stopped. One thread without other ranks is the one
  /// that calls take_finished(), if `inline_one` says so. All references must outlive this object.
  Pool(std::size_t threads, Leader* leader, Work work, const std::atomic<int>* stop,
       bool inline_one = false)
      : leader_(leader),
        work_(std::move(work)),
        stop_asked_(stop),
        threads_(threads, inline_one && leader == nullptr, work_.begin) {}
  /// Stops the tasks that are under way.
  ~Pool() {
    if (!finished()) {
      stop();
    }
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Tasks at a time in this process.
  std::size_t at_a_time() const { return threads_.count(); }

  /// Tasks are started in the order in which they are added.
  void add(std::size_t task) { waiting_.push_back(task); }
  /// A task that is to be carried out once more, before the others.
  void put_back(std::size_t task) { waiting_.push_front(task); }
  /// Starts no more tasks and asks those under way to end, here and on other ranks.
  void stop() {
    if (stop_tasks_.exchange(1) == 0 && leader_ != nullptr) {
      leader_->stop();
    }
  }
  /// True if nothing is left to do or, after stop(), nothing is under way.
  bool finished() const {
    return (stop_tasks_ != 0 || waiting_.empty()) && under_way_ == 0 &&
           (leader_ == nullptr || leader_->busy() == 0);
  }

  /// Starts what can be started and waits at most `most` for results. Rethrows what a task has
  /// thrown here.
  std::vector<Finished> take_finished(std::chrono::milliseconds most) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + most;
    std::vector<Finished> finished;
    do {
      if (stop_asked_ != nullptr && *stop_asked_ != 0) {
        stop();
      }
      start_tasks();
      const auto left = std::chrono::duration_cast<std::chrono::microseconds>(end - Clock::now());
      threads_.wait(leader_ == nullptr ? left : std::min(left, leader_->poll_interval()));
      finished = take_ended();
      take_answers(finished);
    } while (finished.empty() && Clock::now() < end && !this->finished());
    return finished;
  }

 private:
  void start_tasks() {
    while (stop_tasks_ == 0 && !waiting_.empty() && threads_.idle() > 0) {
      ++under_way_;
      threads_.start([this, task = next()] { carry_out(task); });
    }
    while (leader_ != nullptr && stop_tasks_ == 0 && !waiting_.empty() && leader_->idle() > 0) {
      const std::size_t task = next();
      leader_->start(task, work_.request(task));
    }
  }

  std::size_t next() {
    const std::size_t task = waiting_.front();
    waiting_.pop_front();
    return task;
  }

  void carry_out(std::size_t task) noexcept {
    try {
      // While a task runs in the calling thread, nobody copies the one to the other.
      const bool is_inline = threads_.are_inline() && stop_asked_ != nullptr;
      Finished one = {task, work_.carry_out(task, is_inline ? *stop_asked_ : stop_tasks_)};
      const std::lock_guard lock(mutex_);
      ended_.push_back(std::move(one));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }

  std::vector<Finished> take_ended() {
    const std::lock_guard lock(mutex_);
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    under_way_ -= ended_.size();
    return std::exchange(ended_, {});
  }

  void take_answers(std::vector<Finished>& finished) {
    if (leader_ == nullptr) {
      return;
    }
    for (const Leader::Answer& answer : leader_->take_answers()) {
      finished.push_back({answer.task, work_.result(answer.task, answer.result)});
    }
    for (const std::size_t task : leader_->take_lost()) {
      put_back(task);
    }
  }

  Leader* leader_;
  Work work_;
  std::deque<std::size_t> waiting_;
  const std::atomic<int>* stop_asked_;
  std::atomic<int> stop_tasks_ = 0;
  std::size_t under_way_ = 0;  // in threads, with those that have ended
  std::mutex mutex_;           // of all below
  std::vector<Finished> ended_;
  std::exception_ptr failure_;
  Threads threads_;  // last: at the end it waits for its threads, which use the rest
};

}  // namespace clca::tasks
