#pragma once
// The processes that carry out one command together, as mpirun starts them.

#include <cstdint>
#include <optional>
#include <vector>

namespace clca::tasks {

using Bytes = std::vector<std::uint8_t>;

struct Message {
  int from = 0;  ///< rank
  Bytes bytes;
};

/// All of them, seen from one. Called by one thread only.
class Ranks {
 public:
  virtual ~Ranks() = default;

  /// Number of this process, from 0. Rank 0 hands out the tasks and alone prints.
  virtual int rank() const = 0;
  /// Number of all processes.
  virtual int size() const = 0;
  /// Number of those on this machine.
  virtual int on_this_machine() const = 0;
  /// Returns at once; messages from one rank to another arrive in their order. A message to a rank
  /// that has ended is lost.
  virtual void send(int to, Bytes bytes) = 0;
  /// A rank has ended before the others: they cannot end together any more.
  virtual void note_lost_rank() = 0;
  /// The next message, if one has arrived.
  virtual std::optional<Message> receive() = 0;
};

}  // namespace clca::tasks
