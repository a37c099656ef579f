// Steps of the contact model: a packing that is made, and its collapse, at any size.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "clca/contact/contact_model.hpp"

namespace {

namespace contact = clca::contact;
namespace grains = clca::grains;
namespace lattice = clca::lattice;

constexpr std::uint64_t kMaxRunSteps = 1'000'000;

/// Resolution and restitution: the defaults, or for a quick look.
struct Setting {
  double resolution;
  double restitution;
};
constexpr Setting kDefaults = {0.4, 0.4};
constexpr Setting kPreview = {0.8, 0};

/// A rain of small and large hexagons, 1:1, over a bed 1.45 times as high as wide, behind a wall
/// with six times as much room beside it.
contact::ContactModel rain(std::size_t count, contact::Rolling rolling, Setting setting,
                           bool reference) {
  constexpr double kAspect = 1.45;
  const double width = 70 * std::sqrt(static_cast<double>(count) / 540);
  const double height = 6.6 * width;
  grains::State state{.lattice = lattice::Lattice::covering(7 * width, height, false), .seed = 7};
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  state.walls = {{.sites = lattice::sites_in(state.lattice, {width, 0, width + 1, height})}};
  contact::ContactModel model({.grains = std::move(state)},
                              {.rolling = rolling,
                               .restitution = setting.restitution,
                               .resolution = setting.resolution,
                               .fall_height = kAspect * width},
                              {.use_reference = reference});
  const std::vector<std::size_t> counts = {count / 2, count / 2};
  model.fill({0, 0, width, height}, counts);
  return model;
}

/// Steps until all is at rest. Counts them, and time per grain and step.
class Steps {
 public:
  explicit Steps(benchmark::State& bench) : bench_(bench) {}
  Steps(const Steps&) = delete;
  Steps& operator=(const Steps&) = delete;
  ~Steps() {
    using benchmark::Counter;
    bench_.counters["steps"] = Counter(steps_, Counter::kAvgIterations);
    bench_.counters["time_per_grain_and_step"] =
        Counter(updates_, Counter::kIsRate | Counter::kInvert);
  }

  void run(contact::ContactModel& model) {
    const auto grains = static_cast<double>(model.grains().particles.size());
    for (std::uint64_t step = 0; step < kMaxRunSteps && !model.step().settled; ++step) {
      updates_ += grains;
      ++steps_;
    }
  }

 private:
  benchmark::State& bench_;
  double updates_ = 0;
  double steps_ = 0;
};

void settling(benchmark::State& bench, contact::Rolling rolling, Setting setting, bool reference) {
  Steps steps(bench);
  for (auto _ : bench) {
    bench.PauseTiming();
    auto model = rain(static_cast<std::size_t>(bench.range(0)), rolling, setting, reference);
    bench.ResumeTiming();
    steps.run(model);
  }
}

void collapse(benchmark::State& bench, contact::Rolling rolling, Setting setting, bool reference) {
  Steps steps(bench);
  for (auto _ : bench) {
    bench.PauseTiming();
    auto model = rain(static_cast<std::size_t>(bench.range(0)), rolling, setting, reference);
    for (std::uint64_t step = 0; step < kMaxRunSteps && !model.step().settled; ++step) {
    }
    model.remove_wall(0);
    bench.ResumeTiming();
    steps.run(model);
  }
}

using enum contact::Rolling;

BENCHMARK_CAPTURE(settling, contact, resistance, kDefaults, false)
    ->Arg(540)
    ->Arg(5'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(collapse, contact, resistance, kDefaults, false)
    ->Arg(540)
    ->Arg(5'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(collapse, contact_without_rotation, none, kDefaults, false)
    ->Arg(540)
    ->Arg(5'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(collapse, contact_preview, resistance, kPreview, false)
    ->Arg(540)
    ->Arg(5'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(collapse, contact_reference, resistance, kDefaults, true)
    ->Arg(540)
    ->Unit(benchmark::kMillisecond);

}  // namespace
