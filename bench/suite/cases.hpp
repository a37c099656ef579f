#pragma once
// One run of one case, and what is written down of it.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "clca/automaton/automaton.hpp"

namespace clca::bench {

/// falling: all move. settling: a rain comes to rest. collapse: a bed at rest loses its wall.
/// idle: steps in which nothing can move.
enum class Case : std::uint8_t { falling, settling, collapse, idle };
inline constexpr std::array kCases = {Case::falling, Case::settling, Case::collapse, Case::idle};

std::string name(Case a_case);
/// A state from which it starts.
grains::State start(Case a_case, std::size_t particles);

struct Variant {
  automaton::TieBreaking ties = automaton::TieBreaking::particle;
  int threads = 1;
  bool sleeping = true;
};

/// Steps, what they did and how long they took.
struct Work {
  std::uint64_t steps = 0;
  std::uint64_t moved = 0;
  double seconds = 0;
};

/// Lines that a step changed (see Traffic).
struct Sample {
  std::uint64_t moved = 0;
  std::uint64_t lines = 0;
};

inline constexpr std::size_t kShareBins = 16;

struct Run {
  Work all = {};
  /// Steps in which a share of 10^-k/2 or less, but more than 10^-(k+1)/2, of the particles moved.
  std::array<Work, kShareBins> by_share = {};
  bool at_rest = false;  ///< it ended because nothing could move any more
  std::uint64_t hash = 0;
  std::vector<Sample> samples = {};
};

/// Runs to rest, at most `most_steps`. With `sampled` some steps are looked at for their traffic,
/// while the clock stands still.
Run run(Case a_case, grains::State start, const Variant& variant, std::uint64_t most_steps,
        bool sampled);

}  // namespace clca::bench
