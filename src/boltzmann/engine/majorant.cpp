#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "boltzmann/engine/group.hpp"
#include "boltzmann/engine/grouping.hpp"
#include "boltzmann/engine/steps.hpp"
#include "clca/parallel/team.hpp"

namespace clca::boltzmann {

namespace {

/// A group fits into the second-level cache of a core.
constexpr Eigen::Index kGroupSize = 8192;
constexpr double kCollisionsPerStep = 4;  // of a particle
// Under shear: splitting a step of x relaxation times of the stress (1.25 collisions each) makes
// the viscosity too large by x^2 / 12.
constexpr double kCollisionsPerShearedStep = 0.2;
constexpr double kShearPerStep = 0.05;

/// Buffers of one thread.
struct Workspace {
  Group group;
  std::vector<Eigen::Index> sources;  // where the particles of the group lie
  std::vector<Eigen::Index> targets;  // where they will lie after the step
};

/// Result of a group in a step.
struct Outcome {
  std::uint64_t collisions = 0;
  double sum_of_squares = 0;  // of speeds
};

class MajorantIntegrator {
 public:
  MajorantIntegrator(Gas& gas, const Law& law, double shear_rate, std::uint64_t seed, int threads)
      : gas_(gas),
        law_(law),
        shear_rate_(shear_rate),
        seed_(seed),
        grouping_(gas.particle_count(), kGroupSize),
        threads_(static_cast<int>(std::min<Eigen::Index>(threads, grouping_.group_count()))),
        workspaces_(static_cast<std::size_t>(threads_)),
        outcomes_(static_cast<std::size_t>(grouping_.group_count())) {}

  /// One step, at most to `end`.
  void step(double end);

 private:
  double step_duration(double longest) const;
  Outcome advance_group(Eigen::Index number, double duration, Workspace& workspace);

  Gas& gas_;
  const Law& law_;
  double shear_rate_;
  std::uint64_t seed_;
  Grouping grouping_;
  int threads_;  // no more than there are groups: idle ones would only wait for each other
  std::vector<Workspace> workspaces_;
  std::vector<Outcome> outcomes_;
};

double MajorantIntegrator::step_duration(double longest) const {
  const double rate = 4 * std::numbers::inv_sqrtpi * gas_.thermal_speed;
  const double collisions = shear_rate_ > 0 ? kCollisionsPerShearedStep : kCollisionsPerStep;
  const double by_collisions = rate > 0 ? collisions / rate : longest;
  const double by_shear = shear_rate_ > 0 ? kShearPerStep / shear_rate_ : longest;
  // Equal steps up to the end: a short last step would cost as much as a full one.
  constexpr double kOver = 0.25;  // by which a step may be too long
  const double steps = std::ceil(longest / std::min(by_collisions, by_shear) - kOver);
  return steps > 1 ? longest / steps : longest;
}

Outcome MajorantIntegrator::advance_group(Eigen::Index number, double duration,
                                          Workspace& workspace) {
  const double kick = shear_rate_ * duration / 2;
  Group& group = workspace.group;
  grouping_.members(number, workspace.sources, workspace.targets);
  const std::size_t count = workspace.sources.size();
  group.resize(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    constexpr std::size_t kAhead = 64;  // blocks lie anywhere, which the processor does not foresee
    __builtin_prefetch(&gas_.motions(0, workspace.sources[std::min(i + kAhead, count - 1)]));
    auto motion = group.motion(static_cast<Eigen::Index>(i));
    motion = gas_.motions.col(workspace.sources[i]);
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
    gas_.motions.col(workspace.targets[i]) = motion;
  }
  return outcome;
}

void MajorantIntegrator::step(double end) {
  const double longest = end - gas_.time;
  const double length = step_duration(longest);
  const Eigen::Index groups = grouping_.group_count();
  grouping_.shuffle(seed_, gas_.step);
  parallel::FirstFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(threads_) default(shared)
  for (Eigen::Index group = 0; group < groups; ++group) {
    failure.guard([&] {
      outcomes_[static_cast<std::size_t>(group)] =
          advance_group(group, length, workspaces_[static_cast<std::size_t>(omp_get_thread_num())]);
    });
  }
  failure.rethrow();
  double squares = 0;
  for (const Outcome& outcome : outcomes_) {
    gas_.participations += 2 * outcome.collisions;
    squares += outcome.sum_of_squares;
  }
  gas_.thermal_speed = std::sqrt(squares / (3 * static_cast<double>(gas_.particle_count())));
  gas_.time = length < longest ? gas_.time + length : end;
  ++gas_.step;
}

}  // namespace

std::function<void()> majorant_stepper(Gas& gas, const Law& law, double shear_rate,
                                       std::uint64_t seed, double time, int threads) {
  const auto integrator = std::make_shared<MajorantIntegrator>(gas, law, shear_rate, seed, threads);
  return [integrator, time] { integrator->step(time); };
}

}  // namespace clca::boltzmann
