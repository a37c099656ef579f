#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "beds.hpp"
#include "stopwatch.hpp"
#include "traffic.hpp"

namespace clca::bench {

namespace {

using automaton::Automaton;
using grains::StepReport;

constexpr std::uint64_t kSampledSteps = 32;  // one of so many
constexpr double kIdleSeconds = 5e-3;
constexpr std::uint64_t kIdleSteps = 16;  // between looks at the clock

void add(Work& work, const StepReport& report, double seconds) {
  ++work.steps;
  work.moved += report.moved_count;
  work.seconds += seconds;
}

void to_rest(Automaton& automaton) {
  while (!automaton.step().settled) {
  }
}

std::size_t bin_of(double share) {
  const double bin = std::floor(-2 * std::log10(share));
  return std::min(static_cast<std::size_t>(bin), kShareBins - 1);
}

void run_moving(Automaton& automaton, std::uint64_t most_steps, Traffic* traffic, Run& run) {
  const auto particles = static_cast<double>(automaton.state().particles.size());
  while (run.all.steps < most_steps && !run.at_rest) {
    const Stopwatch clock;
    const StepReport report = automaton.step();
    const double seconds = clock.seconds();
    if (traffic != nullptr && run.all.steps % kSampledSteps == 0 && report.moved_count > 0) {
      run.samples.push_back({report.moved_count, traffic->lines(automaton.state())});
    }
    add(run.all, report, seconds);
    if (report.moved_count > 0) {
      add(run.by_share[bin_of(static_cast<double>(report.moved_count) / particles)], report,
          seconds);
    }
    run.at_rest = report.settled;
  }
}

void run_idle(Automaton& automaton, Run& run) {
  const Stopwatch clock;
  do {
    for (std::uint64_t i = 0; i < kIdleSteps; ++i) {
      add(run.all, automaton.step(), 0);
    }
  } while (clock.seconds() < kIdleSeconds);
  run.all.seconds = clock.seconds();
  run.at_rest = run.all.moved == 0;
}

}  // namespace

std::string name(Case a_case) {
  switch (a_case) {
    case Case::falling:
      return "falling";
    case Case::settling:
      return "settling";
    case Case::collapse:
      return "collapse";
    case Case::idle:
      break;
  }
  return "idle";
}

grains::State start(Case a_case, std::size_t particles) {
  switch (a_case) {
    case Case::falling:
      return rain(particles);
    case Case::settling:
      return low_rain(particles);
    case Case::collapse:
    case Case::idle:
      break;
  }
  return walled_bed(particles);
}

Run run(Case a_case, grains::State start, const Variant& variant, std::uint64_t most_steps,
        bool sampled) {
  Automaton automaton(std::move(start), {.ties = variant.ties},
                      {.threads = variant.threads, .allow_sleeping = variant.sleeping});
  std::optional<Traffic> traffic;
  if (sampled) {
    traffic.emplace(automaton.state());
  }
  Run run;
  if (a_case == Case::collapse || a_case == Case::idle) {
    to_rest(automaton);  // who is new looks around once
  }
  if (a_case == Case::idle) {
    run_idle(automaton, run);
    return run;
  }
  if (a_case == Case::collapse) {
    automaton.remove_wall(0);
  }
  run_moving(automaton, a_case == Case::falling ? kFallingSteps : most_steps,
             traffic ? &*traffic : nullptr, run);
  run.hash = grains::hash(automaton.state());
  return run;
}

}  // namespace clca::bench
