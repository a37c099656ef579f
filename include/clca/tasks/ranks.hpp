#pragma once
// The processes that carry out one command together, as mpirun starts them.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace clca::tasks {

using Bytes = std::vector<std::uint8_t>;

struct Message {
  int from = 0;  ///< rank
  std::uint64_t number = 0;
  Bytes bytes;
};

/// A rank cannot begin. what() is one line that names it, the same on all ranks.
class StartError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All ranks, seen from one. Called by one thread only.
///
/// All ranks call begin(). Rank 0 then sends work to each, as often as there is any, and at last
/// dismisses them. For each work the others send the results, each under the number of its task,
/// then kEndOfWork. A rank that is stopped sends kStopped at once.
class Ranks {
 public:
  /// Number of the last message: of rank 0, and of others about one work.
  static constexpr std::uint64_t kEndOfWork = UINT64_MAX;
  static constexpr std::uint64_t kStopped = kEndOfWork - 1;

  virtual ~Ranks() = default;

  /// Number of this process, from 0. Rank 0 alone writes tables and prints.
  virtual int rank() const = 0;
  /// Number of all processes.
  virtual int size() const = 0;
  /// Number of those on this machine.
  virtual int size_on_this_machine() const = 0;

  /// The next number of a counter that all ranks share, from 0 on.
  virtual std::uint64_t next_number() = 0;
  /// Sets the counter of next_number() to 0. By rank 0, while no other rank works.
  virtual void reset_counter() = 0;
  /// Messages from one rank to another arrive in their order.
  virtual void send(int to, std::uint64_t number, const Bytes& bytes) = 0;
  /// The next message, if one has arrived.
  virtual std::optional<Message> receive() = 0;

  /// Waits until all ranks have called it. Throws StartError on all if one has a `failure`, but
  /// not on that one, or if one has another `command` than rank 0.
  void begin(const std::string& command, const std::string& failure = "");
  bool has_begun() const { return has_begun_; }
  /// Whether begin() has thrown nothing anywhere.
  bool is_at_work() const { return is_at_work_; }

  /// For rank 0, until dismiss(): sends each other rank its work, and sets the counter to 0.
  void hand_out_work(const std::function<Bytes(int rank)>& work);
  /// For rank 0: there is no more to do, and what others do is to be stopped. Once is enough.
  void dismiss();
  /// For rank 0: whether this is not about a task but says that another rank is stopped.
  bool is_stop_message(const Message& message);
  /// For rank 0: the signal that has stopped another rank; 0: none has.
  int stop_signal() const { return stop_signal_; }
  /// For the others: tells rank 0, once, that a signal has stopped this one; null and 0: none has.
  void tell_stop(const std::atomic<int>* signal);
  /// For the others: waits for the next work; none after dismiss(). Tells of `stop` meanwhile.
  std::optional<Bytes> wait_for_work(const std::atomic<int>* stop = nullptr);
  /// Whether rank 0 has dismissed the others. They may ask while they work.
  bool is_dismissed();

 private:
  Message wait(const std::atomic<int>* stop = nullptr);
  void send_to_others(std::uint64_t number, const std::string& text);

  bool has_begun_ = false;
  bool is_at_work_ = false;
  bool is_dismissed_ = false;
  int stop_signal_ = 0;
  bool has_told_stop_ = false;
};

/// A process that carries out a command alone.
class OneRank : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  int size_on_this_machine() const override { return 1; }
  std::uint64_t next_number() override { return next_++; }
  void reset_counter() override { next_ = 0; }
  void send(int /*to*/, std::uint64_t /*number*/, const Bytes& /*bytes*/) override {}
  std::optional<Message> receive() override { return std::nullopt; }

 private:
  std::uint64_t next_ = 0;
};

}  // namespace clca::tasks
