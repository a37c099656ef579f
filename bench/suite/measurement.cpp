#include "measurement.hpp"

#include <algorithm>
#include <stdexcept>

#include "stopwatch.hpp"

namespace clca::bench {

namespace {

using automaton::TieBreaking;

constexpr std::size_t kMinRuns = 2;
constexpr std::size_t kMaxRuns = 100;
constexpr std::uint64_t kMinSteps = 100;

/// The first is what the others are compared with.
std::vector<Measurement> variants(Case a_case, std::size_t particles, TieBreaking ties,
                                  const Effort& effort) {
  std::vector<Measurement> all;
  const auto add = [&](int threads, bool sleeping) {
    all.push_back({.a_case = a_case, .particles = particles, .variant = {ties, threads, sleeping}});
  };
  for (int threads = 1; threads <= effort.threads; ++threads) {
    add(threads, true);
  }
  if (particles <= effort.max_unsleeping) {
    add(1, false);
  }
  return all;
}

double seconds_per_step(const Run& run) {
  return run.all.seconds / static_cast<double>(run.all.steps);
}

void require_same(const Run& one, const Run& other, Case a_case) {
  if (one.hash != other.hash) {
    throw std::runtime_error(name(a_case) + ": the state depends on threads or on sleeping");
  }
}

}  // namespace

std::vector<double> Measurement::step_seconds() const {
  std::vector<double> seconds;
  for (const Run& run : runs) {
    seconds.push_back(seconds_per_step(run));
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds;
}

double Measurement::median() const {
  const std::vector<double> seconds = step_seconds();
  const std::size_t half = seconds.size() / 2;
  return seconds.size() % 2 == 1 ? seconds[half] : (seconds[half - 1] + seconds[half]) / 2;
}

const Work& Measurement::work() const {
  return std::min_element(runs.begin(), runs.end(),
                          [](const Run& left, const Run& right) {
                            return seconds_per_step(left) < seconds_per_step(right);
                          })
      ->all;
}

std::vector<Measurement> measure(Case a_case, const grains::State& start, const Effort& effort) {
  const std::size_t particles = start.particles.size();
  const std::uint64_t most_steps = std::max(kMinSteps, effort.max_updates / particles);
  std::vector<Measurement> result;
  for (const TieBreaking ties : {TieBreaking::particle, TieBreaking::direction}) {
    std::vector<Measurement> group = variants(a_case, particles, ties, effort);
    const Stopwatch clock;
    const double enough = effort.seconds * static_cast<double>(group.size());
    for (std::size_t turn = 0; turn < kMaxRuns; ++turn) {
      if (turn >= kMinRuns && clock.seconds() >= enough) {
        break;
      }
      for (Measurement& one : group) {
        const bool sampled = turn == 0 && &one == &group.front();
        one.runs.push_back(run(a_case, start, one.variant, most_steps, sampled));
        require_same(group.front().runs.front(), one.runs.back(), a_case);
      }
    }
    for (Measurement& one : group) {
      one.samples = group.front().runs.front().samples;
      one.speedup = group.front().best() / one.best();
    }
    std::move(group.begin(), group.end(), std::back_inserter(result));
  }
  return result;
}

}  // namespace clca::bench
