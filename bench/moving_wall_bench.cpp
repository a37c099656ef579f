// Steps while walls move: a bed shaken from below, and a plate pushed into a bed, beside the free
// collapse of that same bed. Set up as scenes/convection.yaml and scenes/plate-penetration.yaml, at
// any size.

#include <benchmark/benchmark.h>

#include <cmath>

#include "columns.hpp"

namespace {

namespace automaton = clca::automaton;
namespace grains = clca::grains;
namespace lattice = clca::lattice;

constexpr std::uint64_t kMaxSteps = 1'000'000;

/// What was done in the time that is measured.
class Work {
 public:
  explicit Work(benchmark::State& bench) : bench_(bench) {}
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
  ~Work() {
    using benchmark::Counter;
    bench_.counters["particle_updates_per_second"] = Counter(updates_, Counter::kIsRate);
    bench_.counters["moves_per_second"] = Counter(moves_, Counter::kIsRate);
    bench_.counters["steps"] = Counter(steps_, Counter::kAvgIterations);
  }

  /// Steps until all is at rest or `done`.
  template <class Done>
  void run(automaton::Automaton& automaton, Done done) {
    const auto particles = static_cast<double>(automaton.state().particles.size());
    grains::StepReport report;
    for (std::uint64_t step = 0; step < kMaxSteps && !report.settled && !done(); ++step) {
      report = automaton.step();
      moves_ += static_cast<double>(report.moved_count);
      updates_ += particles;
      ++steps_;
    }
  }

 private:
  benchmark::State& bench_;
  double updates_ = 0;
  double moves_ = 0;
  double steps_ = 0;
};

constexpr auto kNever = [] { return false; };

/// A floor that shakes under `particles` small hexagons at rest.
automaton::Automaton bed_to_shake(std::size_t particles) {
  const double scale = std::sqrt(static_cast<double>(particles) / 420);
  const double width = 52 * scale;
  const double height = 260 * scale;
  grains::State state{.lattice = lattice::Lattice::covering(width, height, false), .seed = 5};
  state.kinds = {{lattice::Shape::hexagon(1), 0}};
  state.walls = {
      {.sites = lattice::sites_in(state.lattice, {0, 0, width, 1}),
       .motion = grains::WallMotion{lattice::Direction::up, grains::Shake{10, std::nullopt}}}};
  automaton::Automaton bed(std::move(state), {.scatter = 1});
  bed.fill({0, 1, width, height}, std::vector<std::size_t>{particles});
  clca::bench::run_steps(bed, kMaxSteps);
  return bed;
}

/// 20 cycles. Range 0: particles.
void shaken_bed(benchmark::State& bench) {
  Work work(bench);
  // NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): the loop of Google Benchmark
  for (auto _ : bench) {
    bench.PauseTiming();
    auto bed = bed_to_shake(static_cast<std::size_t>(bench.range(0)));
    bed.set_wall_moving(0, true);
    bench.ResumeTiming();
    work.run(bed, [&] { return bed.state().walls[0].travel.cycles == 20; });
  }
}

enum BedWall : std::uint8_t { gate, plate };

/// Small and large hexagons, 1:1, at rest between the left side and a gate, and a plate above.
automaton::Automaton bed_to_push(std::size_t particles) {
  const double scale = std::sqrt(static_cast<double>(particles) / 990);
  const double width = 140 * scale;
  const double height = 240 * scale;
  grains::State state{.lattice = lattice::Lattice::covering(3 * width, height, false), .seed = 5};
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  const auto sites = [&](const lattice::Rectangle& box) {
    return lattice::sites_in(state.lattice, box);
  };
  const auto distance = static_cast<std::int32_t>(90 * scale);
  state.walls.resize(2);
  state.walls[gate].sites = sites({width, 0, width + 1, height});
  state.walls[plate] = {
      .sites = sites({66.5 * scale, 110 * scale, 73.5 * scale, height}),
      .present = false,
      .motion = grains::WallMotion{lattice::Direction::down, grains::Drive{4, distance}},
      .passive_rule = grains::PassiveRule::overlap};
  automaton::Automaton bed(std::move(state));
  bed.fill({0, 0, width, height}, std::vector<std::size_t>{particles / 2, particles / 2});
  clca::bench::run_steps(bed, kMaxSteps);
  return bed;
}

/// Until the plate stalls. Range 0: particles.
void plate_pushed_in(benchmark::State& bench) {
  Work work(bench);
  // NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): the loop of Google Benchmark
  for (auto _ : bench) {
    bench.PauseTiming();
    auto bed = bed_to_push(static_cast<std::size_t>(bench.range(0)));
    bed.insert_wall(plate);
    bed.set_wall_moving(plate, true);
    bench.ResumeTiming();
    work.run(bed, kNever);
  }
}

/// The same bed, let go. Range 0: particles.
void collapse_of_that_bed(benchmark::State& bench) {
  Work work(bench);
  // NOLINTNEXTLINE(clang-analyzer-deadcode.DeadStores): the loop of Google Benchmark
  for (auto _ : bench) {
    bench.PauseTiming();
    auto bed = bed_to_push(static_cast<std::size_t>(bench.range(0)));
    bed.remove_wall(gate);
    bench.ResumeTiming();
    work.run(bed, kNever);
  }
}

BENCHMARK(shaken_bed)->Arg(420)->Arg(10'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(plate_pushed_in)->Arg(1'000)->Arg(10'000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(collapse_of_that_bed)
    ->Arg(1'000)
    ->Arg(10'000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
