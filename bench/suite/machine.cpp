#include "machine.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>
#include <utility>

#include "clca/random/draw.hpp"
#include "grains/internal/lazy_array.hpp"
#include "stopwatch.hpp"

namespace clca::bench {

namespace {

constexpr std::size_t kMinWorkingSet = std::size_t{16} << 10U;
constexpr std::size_t kCopiedInARound = std::size_t{32} << 20U;
constexpr std::size_t kHopsInARound = std::size_t{1} << 15U;

/// Keeps the compiler from leaving out what is written to `memory`, or read from it.
void use(const void* memory) {
  asm volatile("" : : "g"(memory) : "memory");  // NOLINT(hicpp-no-assembler)
}

/// The shortest of several rounds; at least five.
template <class Round>
double best_of(double seconds, Round round) {
  const Stopwatch all;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5 || all.seconds() < seconds; ++i) {
    best = std::min(best, round());
  }
  return best;
}

using grains::LazyArray;

CopyRate measured_copy(std::size_t bytes, int threads, double seconds) {
  const std::size_t share = bytes / 2 / static_cast<std::size_t>(threads);
  const std::size_t copies = std::max<std::size_t>(1, kCopiedInARound / bytes);
  struct Pair {
    LazyArray<char> source;
    LazyArray<char> target;
  };
  std::vector<Pair> pairs;
  for (int i = 0; i < threads; ++i) {
    pairs.push_back({LazyArray<char>(share), LazyArray<char>(share)});
  }
  const auto on_each = [&](auto work) {
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (Pair& pair : pairs) {
      work(pair);
    }
  };
  on_each([&](Pair& pair) {
    std::fill_n(pair.source.data(), share, '1');
    std::fill_n(pair.target.data(), share, '2');
  });
  const double best = best_of(seconds, [&] {
    const Stopwatch round;
    on_each([&](Pair& pair) {
      for (std::size_t copy = 0; copy < copies; ++copy) {
        std::memcpy(pair.target.data(), pair.source.data(), share);
        use(pair.target.data());
      }
    });
    return round.seconds();
  });
  const auto touched = static_cast<double>(2 * share * pairs.size() * copies);
  return {bytes, threads, touched / best};
}

constexpr std::size_t kNumbersInALine = kLine / sizeof(std::uint32_t);

/// One closed chain through all lines, in random order (Sattolo 1986): the first number of each
/// is the place of the next.
LazyArray<std::uint32_t> random_chain(std::size_t lines) {
  std::vector<std::uint32_t> order(lines);
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = lines - 1; i > 0; --i) {
    const std::uint64_t bits = random::draw(1, i, 0, random::Purpose::fill_position);
    std::swap(order[i], order[random::uniform_below(bits, i)]);
  }
  LazyArray<std::uint32_t> chain(lines * kNumbersInALine);
  for (std::size_t i = 0; i < lines; ++i) {
    chain[i * kNumbersInALine] = order[i] * static_cast<std::uint32_t>(kNumbersInALine);
  }
  return chain;
}

Latency measured_latency(std::size_t bytes, double seconds) {
  const LazyArray<std::uint32_t> chain = random_chain(bytes / kLine);
  std::uint32_t at = 0;
  const double best = best_of(seconds, [&] {
    const Stopwatch round;
    for (std::size_t hop = 0; hop < kHopsInARound; ++hop) {
      at = chain[at];
    }
    use(&at);
    return round.seconds();
  });
  return {bytes, best / static_cast<double>(kHopsInARound)};
}

}  // namespace

Machine::Machine(std::size_t largest, int threads, double seconds) {
  for (int team = 1; team <= threads; ++team) {
    for (std::size_t bytes = kMinWorkingSet; bytes <= largest; bytes *= 4) {
      copies_.push_back(measured_copy(bytes, team, seconds));
    }
  }
  for (std::size_t bytes = kMinWorkingSet; bytes <= largest; bytes *= 4) {
    latencies_.push_back(measured_latency(bytes, seconds));
  }
}

double Machine::copy_rate(double bytes, int threads) const {
  double rate = 0;
  for (const CopyRate& copy : copies_) {
    if (copy.threads == threads) {
      rate = copy.rate;
      if (static_cast<double>(copy.bytes) >= bytes) {
        break;
      }
    }
  }
  return rate;
}

double Machine::latency(double bytes) const {
  const auto found = std::find_if(latencies_.begin(), latencies_.end(), [&](const Latency& one) {
    return static_cast<double>(one.bytes) >= bytes;
  });
  return (found == latencies_.end() ? latencies_.back() : *found).seconds;
}

std::vector<std::size_t> Machine::working_sets() const {
  std::vector<std::size_t> sets;
  for (const Latency& latency : latencies_) {
    sets.push_back(latency.bytes);
  }
  return sets;
}

store::Table Machine::table() const {
  store::Table table({"quantity", "working_set_bytes", "threads", "value", "unit"});
  for (const CopyRate& copy : copies_) {
    table.add_row({"copy", std::uint64_t{copy.bytes}, static_cast<std::uint64_t>(copy.threads),
                   copy.rate, "bytes/s"});
  }
  for (const Latency& latency : latencies_) {
    table.add_row(
        {"dependent_load", std::uint64_t{latency.bytes}, std::uint64_t{1}, latency.seconds, "s"});
  }
  return table;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with("model name")) {
      return line.substr(line.find(": ") + 2);
    }
  }
  return {};
}

}  // namespace clca::bench
