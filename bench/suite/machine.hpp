#pragma once
// What the machine can do at best: how fast it copies, and how long it waits for its memory.

#include <cstddef>
#include <string>
#include <vector>

#include "clca/store/table.hpp"

namespace clca::bench {

inline constexpr std::size_t kLine = 64;  ///< bytes of a cache line

struct CopyRate {
  std::size_t bytes = 0;  ///< of source and destination, all threads together
  int threads = 1;
  double rate = 0;  ///< bytes read and bytes written, per second
};

struct Latency {
  std::size_t bytes = 0;  ///< over which the chain of loads leads
  double seconds = 0;     ///< of a load whose address is what the one before has found
};

class Machine {
 public:
  /// Measures for working sets of 16 KiB, then four times that, up to `largest` bytes, and for 1 to
  /// `threads` threads; `seconds` for each number.
  Machine(std::size_t largest, int threads, double seconds);

  /// For a working set of so many bytes: that of the next larger one that was measured.
  double copy_rate(double bytes, int threads) const;
  double latency(double bytes) const;

  std::vector<std::size_t> working_sets() const;  ///< bytes, ascending
  /// quantity, working_set_bytes, threads, value, unit
  store::Table table() const;

 private:
  std::vector<CopyRate> copies_;  // by threads, then bytes
  std::vector<Latency> latencies_;
};

/// What the processor calls itself; nothing where the system does not say.
std::string processor_name();

}  // namespace clca::bench
