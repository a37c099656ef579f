#pragma once
// Independent tasks, carried out by threads of this process and by other ranks.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "clca/tasks/ranks.hpp"

namespace clca::tasks {

template <class Result>
class Pool {
 public:
  struct Work {
    /// Carries out a task in a thread of this process, until `stop` is not zero; several at once.
    std::function<Result(std::size_t task, const std::atomic<int>& stop)> carry_out;
    /// For rank 0: the result from what another rank has sent.
    std::function<Result(std::size_t task, const Bytes& answer)> result = {};
    /// Called once in each thread before any task starts; without threads, by the thread that makes
    /// the pool, except with `inline_one`.
    std::function<void()> begin = {};
  };
  struct Finished {
    std::size_t task = 0;
    Result result;
  };

  /// `threads`: tasks at a time in this process, fewer where the system does not allow as many.
  /// `shared`: the same on all ranks; each rank takes the next of them when it has a thread for it.
  /// On rank 0, results of all ranks come together. `stop`: once it is not zero, or rank 0 has
  /// dismissed the others, all tasks are stopped. Who calls take_finished() carries out the tasks
  /// itself where no thread could be started, and with `inline_one` where `threads` is 1 and there
  /// are no other ranks. All references must outlive this object.
  Pool(std::size_t threads, Ranks& ranks, std::vector<std::size_t> shared, Work work,
       const std::atomic<int>* stop, bool inline_one = false)
      : ranks_(ranks),
        shared_(std::move(shared)),
        has_shared_(!shared_.empty()),
        work_(std::move(work)),
        stop_asked_(stop),
        carried_out_(static_cast<std::size_t>(ranks.size())),
        others_at_work_(ranks.rank() == 0 && !ranks.is_dismissed() ? ranks.size() - 1 : 0) {
    if (threads > 1 || !inline_one || ranks.size() > 1) {
      start_threads(threads);
    }
  }
  /// Stops the tasks that are under way.
  ~Pool() {
    if (!finished()) {
      stop();
    }
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Tasks at a time in this process.
  std::size_t tasks_at_a_time() const { return std::max<std::size_t>(threads_.size(), 1); }

  /// A task of this process alone. They are started in this order, before those that are shared.
  void add(std::size_t task) { own_.push_back(task); }
  /// Starts no more tasks and asks those under way to end, on rank 0 those of all ranks.
  void stop() {
    if (stop_tasks_.exchange(1) == 0 && ranks_.rank() == 0) {
      ranks_.dismiss();
    }
  }
  bool is_stopped() const { return stop_tasks_ != 0; }
  /// Lets this process begin further tasks or not.
  void allow_starts(bool starts) { may_start_ = starts; }
  /// Whether none is under way here.
  bool is_idle() const { return under_way_ == 0; }
  /// True if nothing is left to do or, after stop(), nothing is under way.
  bool finished() const {
    return (stop_tasks_ != 0 || (own_.empty() && !has_shared_)) && under_way_ == 0 &&
           others_at_work_ == 0;
  }

  /// Starts tasks and waits at most `most` for results. Rethrows what a task has thrown here.
  std::vector<Finished> take_finished(std::chrono::milliseconds most) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::microseconds kUntilMessages(2000);
    const Clock::time_point end = Clock::now() + most;
    std::vector<Finished> finished;
    do {
      if (ranks_.rank() > 0) {
        ranks_.tell_stop(stop_asked_);
      }
      if ((stop_asked_ != nullptr && *stop_asked_ != 0) || ranks_.is_dismissed()) {
        stop();
      }
      start_tasks();
      if (this->finished()) {
        break;
      }
      const auto left = std::chrono::duration_cast<std::chrono::microseconds>(end - Clock::now());
      finished = take_ended(ranks_.size() == 1 ? left : std::min(left, kUntilMessages));
      if (ranks_.rank() == 0) {
        take_messages(finished);
      }
    } while (finished.empty() && Clock::now() < end && !this->finished());
    return finished;
  }

  /// How many tasks each rank has carried out, for rank 0.
  const std::vector<std::size_t>& carried_out() const { return carried_out_; }

 private:
  void start_threads(std::size_t wanted) {
    try {
      threads_.reserve(wanted);
      while (threads_.size() < wanted) {
        threads_.emplace_back([this](const std::stop_token& over) { carry_out_tasks(over); });
      }
    } catch (const std::exception&) {  // no more can be had
    }
    if (threads_.empty() && work_.begin) {
      work_.begin();
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return begun_ == threads_.size(); });
  }

  /// What a thread does.
  void carry_out_tasks(const std::stop_token& over) {
    std::exception_ptr failure;
    try {
      if (work_.begin) {
        work_.begin();
      }
    } catch (...) {
      failure = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    failure_ = failure ? failure : failure_;
    ++begun_;
    changed_.notify_all();
    if (failure) {
      return;  // take_finished() throws it
    }
    while (changed_.wait(lock, over, [this] { return !queued_.empty(); })) {
      const std::size_t task = queued_.front();
      queued_.pop_front();
      lock.unlock();
      carry_out(task, stop_tasks_);
      lock.lock();
    }
  }

  /// How many tasks can be started now. Without threads the one before is to be taken first.
  std::size_t free_places() {
    const std::lock_guard lock(mutex_);
    return tasks_at_a_time() - (under_way_ - (threads_.empty() ? 0 : ended_.size()));
  }

  void start_tasks() {
    while (may_start_ && stop_tasks_ == 0 && free_places() > 0) {
      const std::optional<std::size_t> task = next_task();
      if (!task) {
        return;
      }
      ++under_way_;
      if (threads_.empty()) {  // nobody copies the one stop to the other meanwhile
        carry_out(*task, stop_asked_ != nullptr ? *stop_asked_ : stop_tasks_);
        continue;
      }
      const std::lock_guard lock(mutex_);
      queued_.push_back(*task);
      changed_.notify_all();
    }
  }

  std::optional<std::size_t> next_task() {
    if (own_.empty() && has_shared_) {
      const std::uint64_t number = ranks_.next_number();
      has_shared_ = number < shared_.size();
      return has_shared_ ? std::optional(shared_[number]) : std::nullopt;
    }
    if (own_.empty()) {
      return std::nullopt;
    }
    const std::size_t task = own_.front();
    own_.pop_front();
    return task;
  }

  void carry_out(std::size_t task, const std::atomic<int>& stop) noexcept {
    try {
      Finished result = {task, work_.carry_out(task, stop)};
      const std::lock_guard lock(mutex_);
      ended_.push_back(std::move(result));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
    changed_.notify_all();
  }

  /// Results of tasks that have ended here; waits for the first, at most so long.
  std::vector<Finished> take_ended(std::chrono::microseconds most) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, most, [this] { return !ended_.empty() || failure_; });
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    under_way_ -= ended_.size();
    carried_out_[static_cast<std::size_t>(ranks_.rank())] += ended_.size();
    return std::exchange(ended_, {});
  }

  void take_messages(std::vector<Finished>& finished) {
    while (const auto message = ranks_.receive()) {
      if (ranks_.is_stop_message(*message)) {
        stop();
      } else if (message->number == Ranks::kEndOfWork) {
        --others_at_work_;
      } else {
        ++carried_out_[static_cast<std::size_t>(message->from)];
        finished.push_back({message->number, work_.result(message->number, message->bytes)});
      }
    }
  }

  Ranks& ranks_;
  std::vector<std::size_t> shared_;
  bool has_shared_;  // of which no rank has begun
  Work work_;
  std::deque<std::size_t> own_;  // of this process alone, waiting
  const std::atomic<int>* stop_asked_;
  std::atomic<int> stop_tasks_ = 0;
  bool may_start_ = true;
  std::size_t under_way_ = 0;  // with those that have ended and are not taken yet
  std::vector<std::size_t> carried_out_;
  int others_at_work_;
  std::mutex mutex_;  // of all below but the threads
  std::condition_variable_any changed_;
  std::size_t begun_ = 0;           // threads
  std::deque<std::size_t> queued_;  // tasks that no thread has begun
  std::vector<Finished> ended_;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;  // last: at the end it waits for them, which use the rest
};

/// For a rank other than 0: carries out its tasks and sends the results to rank 0.
inline void send_results(Pool<Bytes>& pool, Ranks& ranks) {
  constexpr std::chrono::milliseconds kPause(100);
  while (!pool.finished()) {
    for (const auto& [task, result] : pool.take_finished(kPause)) {
      ranks.send(0, task, result);
    }
  }
  ranks.send(0, Ranks::kEndOfWork, {});
}

}  // namespace clca::tasks
