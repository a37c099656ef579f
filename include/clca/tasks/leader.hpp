#pragma once
// Tasks that other ranks carry out: how rank 0 hands them out, and how the others serve it.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "clca/tasks/presence.hpp"
#include "clca/tasks/ranks.hpp"

namespace clca::tasks {

/// How long to wait until looking for messages again: a small part of the time without any.
class PollInterval {
 public:
  void note_message() { last_ = Clock::now(); }
  std::chrono::microseconds now() const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// The other ranks as rank 0 sees them.
class Leader {
 public:
  struct Answer {
    std::size_t task = 0;
    Bytes result;
  };

  /// `lock_file`: for Presence, where all ranks can reach it; made, and removed at the end.
  /// `fingerprint`: of what is carried out; ranks with another one get no tasks. `most`: tasks of a
  /// rank at a time. `warning` gets a line for each rank that cannot be used. Throws
  /// std::system_error.
  Leader(Ranks& ranks, const std::filesystem::path& lock_file, std::uint64_t fingerprint,
         std::size_t most, std::function<void(const std::string&)> warning);
  /// Tells the other ranks that there are no more tasks.
  ~Leader();
  Leader(const Leader&) = delete;
  Leader& operator=(const Leader&) = delete;

  /// Tasks that can be started now.
  std::size_t idle() const;
  /// Tasks under way.
  std::size_t busy() const;
  /// Sends a task to an idle rank; idle() must not be 0.
  void start(std::size_t task, const Bytes& request);
  /// Asks all ranks to break off their tasks and to send what they have.
  void stop();
  /// Reads all messages; returns the results that have come.
  std::vector<Answer> take_answers();
  /// Tasks that each other rank has carried out, by number - 1.
  std::vector<std::size_t> carried_out() const;
  /// Tasks of ranks that have ended without a result.
  std::vector<std::size_t> take_lost();
  std::chrono::microseconds poll_interval() const { return interval_.now(); }

 private:
  struct Rank {
    bool is_useful = false;  // it serves
    Watch watch{true};
    std::size_t idle = 0;
    std::vector<std::size_t> tasks;  // under way
    std::size_t carried_out = 0;     // tasks
  };

  void handle(const Message& message, std::vector<Answer>& answers);
  void greet(int number, std::uint64_t fingerprint, const std::string& greeting);
  void look_for_lost_ranks();
  void give_up(int number, const std::string& why);

  Ranks& ranks_;
  std::filesystem::path lock_file_;
  Presence presence_;
  std::uint64_t fingerprint_;
  std::size_t most_;
  std::function<void(const std::string&)> warning_;
  std::vector<Rank> others_;  // by number; entry 0, rank 0 itself, is unused
  std::vector<std::size_t> lost_;
  bool sees_locks_ = true;
  bool has_lost_ranks_ = false;
  PollInterval interval_;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

/// What another rank does for a task until `stop` is not zero; returns what Leader::Answer has.
/// Called by several threads at once. A rank where it throws takes no more tasks.
using Serve =
    std::function<Bytes(std::size_t task, const Bytes& request, const std::atomic<int>& stop)>;

/// Rank 0 has ended before the others.
class LeaderLostError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Carries out the tasks that rank 0 sends, `threads` at a time, until it says that there are no
/// more or `stop` is not zero. If rank 0 ends before, the tasks under way are carried out to their
/// end, and the first of the ranks that are left throws LeaderLostError.
void serve(Ranks& ranks, std::size_t threads, std::uint64_t fingerprint, const Serve& carry_out,
           const std::atomic<int>* stop);

/// Tells rank 0 why this rank cannot serve. It warns and goes on without.
void refuse_to_serve(Ranks& ranks, const std::string& why);

/// Rank 0 tells all others that there is nothing to do for them, also where it had no Leader.
/// `has_lost_ranks`: some have ended before.
void dismiss(Ranks& ranks, bool has_lost_ranks = false);

}  // namespace clca::tasks
