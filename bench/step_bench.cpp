// Steps of the automaton: particle-updates per second = particles x steps / time.

#include <benchmark/benchmark.h>

#include <limits>

#include "columns.hpp"

namespace {

using clca::automaton::Ties;

constexpr std::uint64_t kToTheEnd = std::numeric_limits<std::uint64_t>::max();

void set_rate(benchmark::State& bench, double updates) {
  bench.counters["particle_updates_per_second"] =
      benchmark::Counter(updates, benchmark::Counter::kIsRate);
}

/// Settling and collapse to rest, default rules. Range 0: particles, 1: threads.
void wall_removal(benchmark::State& bench, Ties ties) {
  double updates = 0;
  for (auto _ : bench) {
    bench.PauseTiming();
    auto automaton = clca::bench::rain(static_cast<std::size_t>(bench.range(0)), ties,
                                       static_cast<int>(bench.range(1)));
    bench.ResumeTiming();
    clca::bench::run_steps(automaton, kToTheEnd);
    automaton.remove_wall(0);
    clca::bench::run_steps(automaton, kToTheEnd);
    updates += static_cast<double>(automaton.state().step) *
               static_cast<double>(automaton.state().particles.size());
  }
  set_rate(bench, updates);
}

/// The first 100 steps of the rain: everything moves. Range as above.
void free_fall(benchmark::State& bench) {
  double updates = 0;
  for (auto _ : bench) {
    bench.PauseTiming();
    auto automaton = clca::bench::rain(static_cast<std::size_t>(bench.range(0)), Ties::particle,
                                       static_cast<int>(bench.range(1)));
    bench.ResumeTiming();
    clca::bench::run_steps(automaton, 100);
    updates += 100 * static_cast<double>(automaton.state().particles.size());
  }
  set_rate(bench, updates);
}

void wall_removal_particle(benchmark::State& bench) {
  wall_removal(bench, Ties::particle);
}
void wall_removal_direction(benchmark::State& bench) {
  wall_removal(bench, Ties::direction);
}

BENCHMARK(wall_removal_particle)
    ->Args({540, 1})
    ->Args({10'000, 1})
    ->Args({100'000, 1})
    ->Args({100'000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(wall_removal_direction)
    ->Args({540, 1})
    ->Args({100'000, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(free_fall)
    ->Args({540, 1})
    ->Args({10'000, 1})
    ->Args({100'000, 1})
    ->Args({1'000'000, 1})
    ->Args({1'000'000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
