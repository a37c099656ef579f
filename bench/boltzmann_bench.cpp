// Collisions per second of the Boltzmann equation, by number of particles and threads.

#include <benchmark/benchmark.h>

#include "clca/boltzmann/scheme.hpp"

namespace clca::boltzmann {
namespace {

constexpr Law kLaw = {.restitution = 0.5, .friction = 0.3, .roughness = 0};
constexpr std::uint64_t kSeed = 1982;

/// From time 0 to `time`; both change in a collision, or `changed` says otherwise.
void cool(benchmark::State& bench, const Scheme& scheme, double time, double changed) {
  const auto particles = static_cast<std::uint64_t>(bench.range(0));
  const auto threads = static_cast<int>(bench.range(1));
  const Gas start = make_gas({.particle_count = particles}, kSeed);
  double collisions = 0;
  for (auto _ : bench) {
    bench.PauseTiming();
    Gas gas = start;
    bench.ResumeTiming();
    advance(gas, {.law = kLaw, .scheme = scheme, .shear_rate = 0}, kSeed, time, threads);
    collisions += static_cast<double>(gas.participations) / changed;
  }
  bench.counters["collisions_per_second"] =
      benchmark::Counter(collisions, benchmark::Counter::kIsRate);
}

/// Until each particle has collided some 6.5 times.
void majorant(benchmark::State& bench) {
  cool(bench, Majorant{}, 5, 2);
}

void ogawa_kato(benchmark::State& bench) {
  cool(bench, OgawaKato{}, 0.5, 1);
}

}  // namespace

BENCHMARK(majorant)
    ->ArgNames({"particles", "threads"})
    ->ArgsProduct({{10'000, 100'000, 1'000'000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(ogawa_kato)
    ->ArgNames({"particles", "threads"})
    ->ArgsProduct({{10'000}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace clca::boltzmann
