#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "clca/tasks/leader.hpp"
#include "clca/tasks/threads.hpp"
#include "tasks/messages.hpp"

namespace clca::tasks {

namespace {

using Clock = std::chrono::steady_clock;

/// One of the ranks but the first.
class Server {
 public:
  Server(Ranks& ranks, std::size_t threads, const Serve& carry_out, const std::atomic<int>* stop)
      : ranks_(ranks), carry_out_(carry_out), stop_(stop), threads_(threads) {}

  void serve(std::uint64_t fingerprint) {
    const std::string lock_file = wait_for_begin();
    if (is_over_) {
      return;
    }
    try {
      presence_.emplace(lock_file, ranks_.rank());
    } catch (const std::system_error& error) {
      refuse_to_serve(ranks_, error.what());
      return;
    }
    const bool is_there = presence_->has(0);
    watch_ = Watch(is_there);
    ranks_.send(0, bytes_of(Kind::greeting, fingerprint,
                            fmt::format("{} {:d}", threads_.count(), is_there)));
    while (!is_over_ || under_way_ > 0) {
      look_around();
      threads_.wait(interval_.now());
      send_answers();
    }
    if (!leader_is_lost_) {
      if (!has_refused_) {
        refuse_to_serve(ranks_, "");  // gives back what has not been begun
      }
      return;
    }
    ranks_.note_lost_rank();
    if (is_first_left()) {
      throw LeaderLostError("rank 0 has ended before the others; the same command goes on");
    }
  }

 private:
  /// Until the lock file is known there is nothing by which to see whether rank 0 is still there.
  std::string wait_for_begin() {
    constexpr std::chrono::minutes kLongest(10);
    const auto start = Clock::now();
    while (Clock::now() - start < kLongest) {
      while (const auto message = ranks_.receive()) {
        const Content content = content_of(message->bytes);
        is_over_ |= content.kind == Kind::end;
        if (content.kind == Kind::begin) {
          return content.text();
        }
      }
      if (is_over_ || is_stopped()) {
        is_over_ = true;
        return "";
      }
      std::this_thread::sleep_for(interval_.now());
    }
    throw std::runtime_error("rank 0 has not begun for 10 minutes");
  }

  void look_around() {
    while (auto message = ranks_.receive()) {
      interval_.note_message();
      Content content = content_of(message->bytes);
      if (content.kind == Kind::request && !is_over_) {
        start(content.number, std::move(content.rest));
      } else if (content.kind == Kind::stop) {
        stop_tasks_ = 1;
      } else if (content.kind == Kind::end) {
        stop_tasks_ = 1;
        is_over_ = true;
        if (content.number != 0) {
          ranks_.note_lost_rank();
        }
      }
    }
    if (is_stopped()) {
      stop_tasks_ = 1;
      is_over_ = true;
    }
    constexpr std::chrono::seconds kPause(1);
    if (!is_over_ && Clock::now() - looked_ >= kPause) {
      looked_ = Clock::now();
      leader_is_lost_ = is_over_ = watch_.has_ended(presence_->has(0));
    }
  }

  bool is_first_left() const {
    int first = 1;
    while (first < ranks_.rank() && !presence_->has(first)) {
      ++first;
    }
    return first == ranks_.rank();
  }

  void start(std::size_t task, Bytes request) {
    ++under_way_;
    threads_.start([this, task, request = std::move(request)] {
      Bytes answer;
      std::string failure;
      try {
        answer = bytes_of(Kind::answer, task, carry_out_(task, request, stop_tasks_));
      } catch (const std::bad_alloc&) {
        failure = "out of memory";
      } catch (const std::exception& error) {
        failure = error.what();
      }
      const std::lock_guard lock(mutex_);
      failure_ = failure_.empty() ? failure : failure_;
      ended_.push_back(std::move(answer));
    });
  }

  void send_answers() {
    std::vector<Bytes> ended;
    {
      const std::lock_guard lock(mutex_);
      std::swap(ended, ended_);
      if (!failure_.empty() && !has_refused_) {
        refuse_to_serve(ranks_, failure_);
        is_over_ = has_refused_ = true;
      }
    }
    for (Bytes& answer : ended) {
      --under_way_;
      interval_.note_message();
      if (!answer.empty()) {
        ranks_.send(0, std::move(answer));
      }
    }
  }

  bool is_stopped() const { return stop_ != nullptr && stop_->load() != 0; }

  Ranks& ranks_;
  const Serve& carry_out_;
  const std::atomic<int>* stop_;
  std::optional<Presence> presence_;
  Watch watch_;  // of rank 0
  PollInterval interval_;
  Clock::time_point looked_ = Clock::now();
  bool is_over_ = false;
  bool leader_is_lost_ = false;
  bool has_refused_ = false;
  std::size_t under_way_ = 0;
  std::atomic<int> stop_tasks_ = 0;
  std::mutex mutex_;
  std::vector<Bytes> ended_;  // answers; empty where a task has failed
  std::string failure_;       // of the first; rank 0 has its tasks done elsewhere
  Threads threads_;           // last: at the end it waits for its threads, which use the rest
};

}  // namespace

void serve(Ranks& ranks, std::size_t threads, std::uint64_t fingerprint, const Serve& carry_out,
           const std::atomic<int>* stop) {
  Server(ranks, threads, carry_out, stop).serve(fingerprint);
}

void refuse_to_serve(Ranks& ranks, const std::string& why) {
  ranks.send(0, bytes_of(Kind::refusal, 0, why));
}

}  // namespace clca::tasks
