#include "boltzmann/majorant.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "boltzmann/group.hpp"
#include "boltzmann/grouping.hpp"
#include "clca/parallel/first_failure.hpp"

namespace clca::boltzmann {

namespace {

/// So that a group lies in the second-level cache of a core.
constexpr Eigen::Index kGroupSize = 8192;
constexpr double kCollisionsPerStep = 4;  // of a particle
// Under shear: the kicks before and after a step of x relaxation times of the stress (1.25
// collisions each) make the viscosity too large by x^2 / 12.
constexpr double kCollisionsPerShearedStep = 0.2;
constexpr double kShearPerStep = 0.05;

/// What one thread works with.
struct Workbench {
  Group group;
  std::vector<Eigen::Index> now;   // where the particles of the group lie
  std::vector<Eigen::Index> then;  // where they will lie after the step
};

/// What came of a group in a step.
struct Outcome {
  std::uint64_t collisions = 0;
  double sum_of_squares = 0;  // of speeds
};

class Stepper {
 public:
  Stepper(Gas& gas, const Law& law, double shear_rate, std::uint64_t seed, int threads)
      : gas_(gas),
        law_(law),
        shear_rate_(shear_rate),
        seed_(seed),
        grouping_(gas.particles(), kGroupSize),
        threads_(static_cast<int>(std::min<Eigen::Index>(threads, grouping_.groups()))),
        benches_(static_cast<std::size_t>(threads_)),
        outcomes_(static_cast<std::size_t>(grouping_.groups())) {}

  /// Not beyond `end`.
  void step(double end);

 private:
  double duration(double longest) const;
  Outcome work(Eigen::Index number, double duration, Workbench& bench);

  Gas& gas_;
  const Law& law_;
  double shear_rate_;
  std::uint64_t seed_;
  Grouping grouping_;
  int threads_;  // no more than there are groups: idle ones would only wait for each other
  std::vector<Workbench> benches_;
  std::vector<Outcome> outcomes_;
};

double Stepper::duration(double longest) const {
  const double rate = 4 * std::numbers::inv_sqrtpi * gas_.thermal_speed;
  const double collisions = shear_rate_ > 0 ? kCollisionsPerShearedStep : kCollisionsPerStep;
  const double by_collisions = rate > 0 ? collisions / rate : longest;
  const double by_shear = shear_rate_ > 0 ? kShearPerStep / shear_rate_ : longest;
  // Of equal steps to the end, so that none is short: each costs a walk through all particles.
  constexpr double kOver = 0.25;  // by which a step may be too long
  const double steps = std::ceil(longest / std::min(by_collisions, by_shear) - kOver);
  return steps > 1 ? longest / steps : longest;
}

Outcome Stepper::work(Eigen::Index number, double duration, Workbench& bench) {
  const double kick = shear_rate_ * duration / 2;
  Group& group = bench.group;
  grouping_.members(number, bench.now, bench.then);
  const std::size_t count = bench.now.size();
  group.resize(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    constexpr std::size_t kAhead = 64;  // runs lie anywhere, which the processor does not foresee
    __builtin_prefetch(&gas_.motions(0, bench.now[std::min(i + kAhead, count - 1)]));
    auto motion = group.motion(static_cast<Eigen::Index>(i));
    motion = gas_.motions.col(bench.now[i]);
    motion[0] -= kick * motion[1];
  }
  Outcome outcome;
  outcome.collisions = group.collide(
      law_, {seed_, static_cast<std::uint32_t>(gas_.step), static_cast<std::uint32_t>(number)},
      duration);
  for (std::size_t i = 0; i < count; ++i) {
    auto motion = group.motion(static_cast<Eigen::Index>(i));
    motion[0] -= kick * motion[1];
    outcome.sum_of_squares += motion.head<3>().square().sum();
    gas_.motions.col(bench.then[i]) = motion;
  }
  return outcome;
}

void Stepper::step(double end) {
  const double longest = end - gas_.time;
  const double length = duration(longest);
  const Eigen::Index groups = grouping_.groups();
  grouping_.shuffle(seed_, gas_.step);
  parallel::FirstFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(threads_) default(shared)
  for (Eigen::Index group = 0; group < groups; ++group) {
    failure.guard([&] {
      outcomes_[static_cast<std::size_t>(group)] =
          work(group, length, benches_[static_cast<std::size_t>(omp_get_thread_num())]);
    });
  }
  failure.rethrow();
  double squares = 0;
  for (const Outcome& outcome : outcomes_) {
    gas_.participations += 2 * outcome.collisions;
    squares += outcome.sum_of_squares;
  }
  gas_.thermal_speed = std::sqrt(squares / (3 * static_cast<double>(gas_.particles())));
  gas_.time = length < longest ? gas_.time + length : end;
  ++gas_.step;
}

}  // namespace

void advance_majorant(Gas& gas, const Law& law, double shear_rate, std::uint64_t seed, double time,
                      int threads, const KeepsOn& keeps_on) {
  Stepper stepper(gas, law, shear_rate, seed, threads);
  bool goes_on = true;
  while (goes_on && gas.time < time) {
    stepper.step(time);
    goes_on = !keeps_on || keeps_on(gas);
  }
}

}  // namespace clca::boltzmann
