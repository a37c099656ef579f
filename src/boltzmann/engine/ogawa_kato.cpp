#include "boltzmann/engine/ogawa_kato.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "boltzmann/engine/partner_draws.hpp"
#include "boltzmann/rule/colliding_pair.hpp"
#include "clca/parallel/first_failure.hpp"

namespace clca::boltzmann {
namespace {

constexpr std::uint32_t kStepShift = 1;       // 0 is that of the initial condition
constexpr std::uint64_t kMinPerThread = 256;  // with fewer, threads would only wait

Vector3<double> velocity(const Motions& motions, ParticleIndex particle) {
  return {motions(0, particle), motions(1, particle), motions(2, particle)};
}

Vector3<double> spin(const Motions& motions, ParticleIndex particle) {
  return {motions(3, particle), motions(4, particle), motions(5, particle)};
}

Vector3<double> difference(const Vector3<double>& a, const Vector3<double>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

double length(const Vector3<double>& vector) {
  return std::sqrt(dot(vector, vector));
}

// Constants of a step.
struct SynchronousStep {
  const Motions& before;
  const Law& law;
  double duration;
};

// Partners of one particle and their relative speeds.
struct PartnerSpeeds {
  explicit PartnerSpeeds(int partners)
      : indices(static_cast<std::size_t>(partners)), speeds(indices.size()) {}

  std::vector<ParticleIndex> indices;
  std::vector<double> speeds;

  double total() const { return std::accumulate(speeds.begin(), speeds.end(), 0.0); }
  // A partner drawn in proportion to its relative speed.
  ParticleIndex chosen(double u) const {
    double rest = u * total();
    std::size_t k = 0;
    while (k + 1 < speeds.size() && rest >= speeds[k]) {
      rest -= speeds[k++];
    }
    return indices[k];
  }
};

template <class Draws>
std::optional<ParticleIndex> collision_partner(const SynchronousStep& step, const Draws& draws,
                                               ParticleIndex particle,
                                               PartnerSpeeds& partner_speeds) {
  draws.partners(particle, partner_speeds.indices);
  const Vector3<double> own = velocity(step.before, particle);
  std::transform(
      partner_speeds.indices.begin(), partner_speeds.indices.end(), partner_speeds.speeds.begin(),
      [&](ParticleIndex other) { return length(difference(own, velocity(step.before, other))); });
  const double rate = partner_speeds.total() / static_cast<double>(partner_speeds.speeds.size());
  const auto [whether, which] = draws.acceptance_draws(particle);
  // U < 1 - exp(-x) is equivalent to -log(1 - U) < x, and 1 - U is as uniform as U.
  if (-logarithm(whether) >= rate * step.duration) {
    return std::nullopt;
  }
  return partner_speeds.chosen(which);
}

template <class Draws>
void collide(const SynchronousStep& step, const Draws& draws, ParticleIndex particle,
             ParticleIndex other, Eigen::Ref<Eigen::Array<double, 6, 1>> motion) {
  const Vector3<double> g =
      difference(velocity(step.before, particle), velocity(step.before, other));
  const Vector3<double> w1 = spin(step.before, particle);
  const Vector3<double> w2 = spin(step.before, other);
  const auto [height, turn] = draws.direction(particle);
  const auto [push, twist] =
      solid_collision<double>(step.law, g, {w1.x + w2.x, w1.y + w2.y, w1.z + w2.z},
                              line_of_centres<double>(g, height, turn));
  motion(0) -= push.x;
  motion(1) -= push.y;
  motion(2) -= push.z;
  motion(3) -= kSolidSpin * twist.x;
  motion(4) -= kSolidSpin * twist.y;
  motion(5) -= kSolidSpin * twist.z;
}

// Returns the number of particles that changed.
template <class Draws>
std::uint64_t take(const SynchronousStep& step, const Draws& draws, int partners, int threads,
                   Motions& after) {
  std::uint64_t changed = 0;
  std::vector<PartnerSpeeds> partner_speeds(static_cast<std::size_t>(threads),
                                            PartnerSpeeds(partners));
  parallel::FirstFailure failure;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(+ : changed)
  for (Eigen::Index column = 0; column < step.before.cols(); ++column) {
    failure.guard([&] {
      const auto particle = static_cast<ParticleIndex>(column);
      after.col(column) = step.before.col(column);
      const auto other = collision_partner(
          step, draws, particle, partner_speeds[static_cast<std::size_t>(omp_get_thread_num())]);
      if (other) {
        collide(step, draws, particle, *other, after.col(column));
        ++changed;
      }
    });
  }
  failure.rethrow();
  return changed;
}

// Sorts by speed, stable.
Motions sorted_by_speed(const Motions& motions) {
  std::vector<std::pair<double, Eigen::Index>> order;
  order.reserve(static_cast<std::size_t>(motions.cols()));
  for (Eigen::Index column = 0; column < motions.cols(); ++column) {
    const auto v = velocity(motions, static_cast<ParticleIndex>(column));
    order.emplace_back(dot(v, v), column);
  }
  std::sort(order.begin(), order.end());
  Motions sorted(motions.rows(), motions.cols());
  Eigen::Index rank = 0;
  for (const auto& [square, column] : order) {
    sorted.col(rank++) = motions.col(column);
  }
  return sorted;
}

// Steps end at multiples of their duration and at the requested time, so that stopping and resuming
// does not change them.
// Adding up durations would accumulate rounding errors.
class StepEnds {
 public:
  StepEnds(double duration, double last) : duration_(duration), last_(last) {}

  // The end of the step that begins at `time`.
  double after(double time) const {
    // A remainder that is only rounding gets no step of its own.
    constexpr double kRest = 1e-6;
    const double number = std::floor(time / duration_ + kRest) + 1;
    const double end = number * duration_;
    return end > last_ - kRest * duration_ ? last_ : end;
  }

 private:
  double duration_;
  double last_;
};

}  // namespace

void advance_ogawa_kato(Gas& gas, const Law& law, const OgawaKato& scheme, std::uint64_t seed,
                        double time, int threads, const ContinueCondition& keep_going) {
  if (!(scheme.time_step > 0 && std::isfinite(scheme.time_step)) || scheme.partners < 1) {
    throw std::invalid_argument("time step and number of partners must be positive");
  }
  const auto particles = static_cast<std::uint64_t>(gas.particles());
  const StepEnds steps(scheme.time_step, time);
  const int useful = static_cast<int>(
      std::min(static_cast<std::uint64_t>(threads), 1 + particles / kMinPerThread));
  std::optional<LatticeRule> rule;
  if (scheme.quasi) {
    rule.emplace(particles);
  }
  Motions before(gas.motions.rows(), gas.motions.cols());
  while (gas.time < time) {
    const double end = steps.after(gas.time);
    const IndependentDraws draws(seed, gas.step, particles);
    const SynchronousStep step = {.before = before, .law = law, .duration = end - gas.time};
    if (rule) {
      before = sorted_by_speed(gas.motions);
      rule->shift(seed, {.step = static_cast<std::uint32_t>(gas.step), .group = kStepShift});
      gas.participations +=
          take(step, LatticeDraws(*rule, draws), scheme.partners, useful, gas.motions);
    } else {
      before.swap(gas.motions);
      gas.participations += take(step, draws, scheme.partners, useful, gas.motions);
    }
    gas.time = end;
    ++gas.step;
    if (keep_going && !keep_going(gas)) {
      return;
    }
  }
}

}  // namespace clca::boltzmann
