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
#include "clca/parallel/team.hpp"
#include "clca/random/words.hpp"

namespace clca::boltzmann {
namespace {

constexpr std::uint32_t kStepShift = 1;       // Counter::group of shifts; 0 is in gas.cpp
constexpr std::uint64_t kMinPerThread = 256;  // particles: with fewer, threads would only wait

/// Index of a particle, or its rank if they are sorted.
using ParticleIndex = std::uint32_t;

/// Random numbers of a particle in a step: independent, or those of one point of a shifted lattice,
/// the particles ordered by the first coordinate (L'Ecuyer, Lecot & Tuffin 2008, array-RQMC).
/// Partners beyond the dimensions of the rule are drawn independently.
class Draws {
 public:
  /// `rule`: null for independent ones.
  Draws(std::uint64_t seed, std::uint64_t step, std::uint64_t particles, const LatticeRule* rule)
      : seed_(seed), step_(static_cast<std::uint32_t>(step)), others_(particles - 1), rule_(rule) {}

  /// Partners other than `particle`, with replacement.
  void partners(ParticleIndex particle, std::span<ParticleIndex> result) const {
    if (rule_ == nullptr || result.size() > kPartners) {
      random::Words words{};
      for (std::uint32_t k = 0; k < result.size(); ++k) {
        if (k % words.size() == 0) {
          const auto group = static_cast<std::uint32_t>(k / words.size());
          words = random::drawn_words(seed_, {step_, group, particle}, random::Purpose::partner);
        }
        result[k] =
            other(particle, static_cast<ParticleIndex>((words[k % words.size()] * others_) >> 32U));
      }
    }
    if (rule_ != nullptr) {
      const auto others = static_cast<double>(others_);
      int dimension = kFirstPartner;
      for (ParticleIndex& partner : result.first(std::min(result.size(), kPartners))) {
        const double share = rule_->coordinate(particle, dimension++);
        partner = other(particle, static_cast<ParticleIndex>(share * others));
      }
    }
  }
  /// Two numbers of (0, 1): whether it collides, and with which partner.
  std::array<double, 2> acceptance_draws(ParticleIndex particle) const {
    return two_draws(particle, random::Purpose::candidate, 1);
  }
  /// Two numbers of (0, 1), for the line of centres.
  std::array<double, 2> line_of_centres_draws(ParticleIndex particle) const {
    return two_draws(particle, random::Purpose::normal, 3);
  }

 private:
  // Dimensions of the rule from kFirstPartner on are those of partners.
  static constexpr int kFirstPartner = 5;
  static constexpr std::size_t kPartners = LatticeRule::kDimensions - kFirstPartner;

  static ParticleIndex other(ParticleIndex particle, ParticleIndex number) {
    return number + (number >= particle ? 1 : 0);
  }
  /// `dimension`: the first of two of the rule.
  std::array<double, 2> two_draws(ParticleIndex particle, random::Purpose purpose,
                                  int dimension) const {
    if (rule_ != nullptr) {
      return {rule_->coordinate(particle, dimension), rule_->coordinate(particle, dimension + 1)};
    }
    const random::Words words = random::drawn_words(seed_, {step_, 0, particle}, purpose);
    return {open_uniform(random::joined(words[0], words[1])),
            open_uniform(random::joined(words[2], words[3]))};
  }

  std::uint64_t seed_;
  std::uint32_t step_;
  std::uint64_t others_;
  const LatticeRule* rule_;
};

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

std::optional<ParticleIndex> collision_partner(const SynchronousStep& step, const Draws& draws,
                                               ParticleIndex particle,
                                               PartnerSpeeds& partner_speeds) {
  draws.partners(particle, partner_speeds.indices);
  const Eigen::Array3d own = step.before.col(particle).head<3>();
  std::ranges::transform(partner_speeds.indices, partner_speeds.speeds.begin(),
                         [&](ParticleIndex other) {
                           const double x = own[0] - step.before(0, other);
                           const double y = own[1] - step.before(1, other);
                           const double z = own[2] - step.before(2, other);
                           return std::sqrt(x * x + y * y + z * z);
                         });
  const double rate = partner_speeds.total() / static_cast<double>(partner_speeds.speeds.size());
  const auto [whether, which] = draws.acceptance_draws(particle);
  // U < 1 - exp(-x) is equivalent to -log(1 - U) < x, and 1 - U is as uniform as U.
  if (-logarithm(whether) >= rate * step.duration) {
    return std::nullopt;
  }
  return partner_speeds.chosen(which);
}

// Returns the number of particles that changed.
std::uint64_t advance_particles(const SynchronousStep& step, const Draws& draws, int partners,
                                int threads, Motions& after) {
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
        const auto [height, azimuth] = draws.line_of_centres_draws(particle);
        Collisions<1> collision;
        collision.first = step.before.col(column).transpose();
        collision.second = step.before.col(*other).transpose();
        collision.height.setConstant(height);
        collision.azimuth.setConstant(azimuth);
        collision.compute(step.law);
        after.col(column) = collision.first.transpose();
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
    order.emplace_back(squared(motions.col(column).head<3>()), column);
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
// stopping and resuming does not change the steps. Adding durations would add rounding errors.
double step_end(double time, double duration, double last) {
  constexpr double kRest = 1e-6;  // a remainder that is only rounding gets no step of its own
  const double end = (std::floor(time / duration + kRest) + 1) * duration;
  return end > last - kRest * duration ? last : end;
}

}  // namespace

std::function<void()> ogawa_kato_stepper(Gas& gas, const Law& law, const OgawaKato& scheme,
                                         std::uint64_t seed, double time, int threads) {
  const auto particles = static_cast<std::uint64_t>(gas.particle_count());
  const int useful = static_cast<int>(
      std::min(static_cast<std::uint64_t>(threads), 1 + particles / kMinPerThread));
  std::optional<LatticeRule> rule;
  if (scheme.quasi_random) {
    rule.emplace(particles);
  }
  return [=, &gas, &law, before = Motions(gas.motions.rows(), gas.motions.cols())]() mutable {
    const double end = step_end(gas.time, scheme.time_step, time);
    const Draws draws(seed, gas.step, particles, rule ? &*rule : nullptr);
    const SynchronousStep step = {.before = before, .law = law, .duration = end - gas.time};
    if (rule) {
      before = sorted_by_speed(gas.motions);
      rule->shift(seed, {.step = static_cast<std::uint32_t>(gas.step), .group = kStepShift});
    } else {
      before.swap(gas.motions);
    }
    gas.participations += advance_particles(step, draws, scheme.partner_count, useful, gas.motions);
    gas.time = end;
    ++gas.step;
  };
}

}  // namespace clca::boltzmann
