#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "boltzmann/elementary.hpp"
#include "boltzmann/engine/steps.hpp"
#include "boltzmann/lattice_rule.hpp"
#include "boltzmann/rule/solid_collision.hpp"
#include "clca/parallel/first_failure.hpp"
#include "clca/random/words.hpp"

namespace clca::boltzmann {
namespace {

constexpr std::uint32_t kStepShift = 1;       // 0 is that of the initial condition
constexpr std::uint64_t kMinPerThread = 256;  // with fewer, threads would only wait

// Random numbers of a particle in a step: independent, or a point of a lattice rule.

/// Index of a particle, or its rank if they are sorted.
using ParticleIndex = std::uint32_t;

class IndependentDraws {
 public:
  IndependentDraws(std::uint64_t seed, std::uint64_t step, std::uint64_t particles)
      : seed_(seed), step_(static_cast<std::uint32_t>(step)), others_(particles - 1) {}

  /// Partners other than `particle`, with replacement.
  void partners(ParticleIndex particle, std::span<ParticleIndex> result) const {
    random::Words words{};
    for (std::uint32_t k = 0; k < result.size(); ++k) {
      if (k % words.size() == 0) {
        words =
            random::words(seed_, counter(particle, static_cast<std::uint32_t>(k / words.size())),
                          random::Purpose::partner);
      }
      const auto other = static_cast<ParticleIndex>((words[k % words.size()] * others_) >> 32U);
      result[k] = other + (other >= particle ? 1 : 0);
    }
  }
  /// Two numbers of (0, 1): whether it collides, and with which partner.
  std::array<double, 2> acceptance_draws(ParticleIndex particle) const {
    return pair(particle, random::Purpose::candidate);
  }
  /// Two numbers of (0, 1), for the line of centres.
  std::array<double, 2> direction(ParticleIndex particle) const {
    return pair(particle, random::Purpose::normal);
  }

 private:
  random::Counter counter(ParticleIndex particle, std::uint32_t group) const {
    return {.step = step_, .group = group, .item = particle};
  }
  std::array<double, 2> pair(ParticleIndex particle, random::Purpose purpose) const {
    const random::Words words = random::words(seed_, counter(particle, 0), purpose);
    return {open_unit(random::join(words[0], words[1])),
            open_unit(random::join(words[2], words[3]))};
  }

  std::uint64_t seed_;
  std::uint32_t step_;
  std::uint64_t others_;
};

/// Each particle takes one point of a shifted lattice, ordered by the first coordinate (L'Ecuyer,
/// Lecot & Tuffin 2008, array-RQMC).
/// Partners beyond the dimensions of the rule are drawn independently.
class LatticeDraws {
 public:
  LatticeDraws(const LatticeRule& rule, const IndependentDraws& further)
      : rule_(rule), further_(further) {}

  void partners(ParticleIndex particle, std::span<ParticleIndex> result) const {
    if (result.size() > kPartners) {
      further_.partners(particle, result);
    }
    const auto others = static_cast<double>(rule_.points() - 1);
    int dimension = kFirstPartner;
    for (ParticleIndex& partner : result.first(std::min(result.size(), kPartners))) {
      const auto other =
          static_cast<ParticleIndex>(rule_.coordinate(particle, dimension++) * others);
      partner = other + (other >= particle ? 1 : 0);
    }
  }
  std::array<double, 2> acceptance_draws(ParticleIndex particle) const {
    return {rule_.coordinate(particle, 1), rule_.coordinate(particle, 2)};
  }
  std::array<double, 2> direction(ParticleIndex particle) const {
    return {rule_.coordinate(particle, 3), rule_.coordinate(particle, 4)};
  }

 private:
  static constexpr int kFirstPartner = 5;
  static constexpr std::size_t kPartners = LatticeRule::kDimensions - kFirstPartner;

  const LatticeRule& rule_;
  const IndependentDraws& further_;
};

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
  const auto [height, azimuth] = draws.direction(particle);
  const auto [push, twist] =
      solid_collision<double>(step.law, g, {w1.x + w2.x, w1.y + w2.y, w1.z + w2.z},
                              line_of_centres<double>(g, height, azimuth));
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

// The end of a step that begins at `time`: a multiple of the duration or the last one, so that
// stopping and resuming does not change the steps. Adding up durations would accumulate rounding
// errors.
double step_end(double time, double duration, double last) {
  constexpr double kRest = 1e-6;  // a remainder that is only rounding gets no step of its own
  const double end = (std::floor(time / duration + kRest) + 1) * duration;
  return end > last - kRest * duration ? last : end;
}

}  // namespace

std::function<void()> ogawa_kato_steps(Gas& gas, const Law& law, const OgawaKato& scheme,
                                       std::uint64_t seed, double time, int threads) {
  const auto particles = static_cast<std::uint64_t>(gas.particles());
  const int useful = static_cast<int>(
      std::min(static_cast<std::uint64_t>(threads), 1 + particles / kMinPerThread));
  std::optional<LatticeRule> rule;
  if (scheme.quasi) {
    rule.emplace(particles);
  }
  return [=, &gas, &law, before = Motions(gas.motions.rows(), gas.motions.cols())]() mutable {
    const double end = step_end(gas.time, scheme.time_step, time);
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
  };
}

}  // namespace clca::boltzmann
