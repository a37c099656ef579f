#include "boltzmann/ogawa_kato.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "boltzmann/encounter.hpp"
#include "boltzmann/partner_draws.hpp"
#include "clca/parallel/first_failure.hpp"

namespace clca::boltzmann {
namespace {

constexpr std::uint32_t kStepShift = 1;          // 0 is that of the beginning
constexpr std::uint64_t kFewestPerThread = 256;  // with fewer, threads would only wait

Triple<double> velocity(const Motions& motions, Place place) {
  return {motions(0, place), motions(1, place), motions(2, place)};
}

Triple<double> spin(const Motions& motions, Place place) {
  return {motions(3, place), motions(4, place), motions(5, place)};
}

Triple<double> difference(const Triple<double>& a, const Triple<double>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

double length(const Triple<double>& vector) {
  return std::sqrt(dot(vector, vector));
}

// What does not change during a step.
struct SynchronousStep {
  const Motions& before;
  const Law& law;
  double duration;
};

// Partners of one particle, and how fast it meets each.
struct Encounters {
  explicit Encounters(int partners)
      : places(static_cast<std::size_t>(partners)), speeds(places.size()) {}

  std::vector<Place> places;
  std::vector<double> speeds;

  double total() const { return std::accumulate(speeds.begin(), speeds.end(), 0.0); }
  // With probability in proportion to the speed.
  Place chosen(double u) const {
    double rest = u * total();
    std::size_t k = 0;
    while (k + 1 < speeds.size() && rest >= speeds[k]) {
      rest -= speeds[k++];
    }
    return places[k];
  }
};

template <class Draws>
std::optional<Place> collision_partner(const SynchronousStep& step, const Draws& draws, Place place,
                                       Encounters& encounters) {
  draws.partners(place, encounters.places);
  const Triple<double> own = velocity(step.before, place);
  std::transform(
      encounters.places.begin(), encounters.places.end(), encounters.speeds.begin(),
      [&](Place other) { return length(difference(own, velocity(step.before, other))); });
  const double rate = encounters.total() / static_cast<double>(encounters.speeds.size());
  const auto [whether, which] = draws.verdict(place);
  // U < 1 - exp(-x) is -log(1 - U) < x, and 1 - U as good a draw as U.
  if (-logarithm(whether) >= rate * step.duration) {
    return std::nullopt;
  }
  return encounters.chosen(which);
}

template <class Draws>
void hit(const SynchronousStep& step, const Draws& draws, Place place, Place other,
         Eigen::Ref<Eigen::Array<double, 6, 1>> motion) {
  const Triple<double> g = difference(velocity(step.before, place), velocity(step.before, other));
  const Triple<double> w1 = spin(step.before, place);
  const Triple<double> w2 = spin(step.before, other);
  const auto [height, turn] = draws.direction(place);
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

// Number of particles that changed.
template <class Draws>
std::uint64_t take(const SynchronousStep& step, const Draws& draws, int partners, int threads,
                   Motions& after) {
  std::uint64_t changed = 0;
  std::vector<Encounters> encounters(static_cast<std::size_t>(threads), Encounters(partners));
  parallel::FirstFailure failure;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(+ : changed)
  for (Eigen::Index column = 0; column < step.before.cols(); ++column) {
    failure.guard([&] {
      const auto place = static_cast<Place>(column);
      after.col(column) = step.before.col(column);
      const auto other = collision_partner(
          step, draws, place, encounters[static_cast<std::size_t>(omp_get_thread_num())]);
      if (other) {
        hit(step, draws, place, *other, after.col(column));
        ++changed;
      }
    });
  }
  failure.rethrow();
  return changed;
}

// Slow ones first; those of equal speed stay in order.
Motions sorted_by_speed(const Motions& motions) {
  std::vector<std::pair<double, Eigen::Index>> order;
  order.reserve(static_cast<std::size_t>(motions.cols()));
  for (Eigen::Index column = 0; column < motions.cols(); ++column) {
    const auto v = velocity(motions, static_cast<Place>(column));
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

// Steps end at multiples of their duration, and at the time asked for: the same ones however often
// a run has been stopped in between. Adding up would gather rounding errors.
class StepEnds {
 public:
  StepEnds(double duration, double last) : duration_(duration), last_(last) {}

  // The end of the step that begins at `time`.
  double after(double time) const {
    // A rest that is nothing but rounding gets no step of its own.
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
                        double time, int threads, const KeepsOn& keeps_on) {
  if (!(scheme.time_step > 0 && std::isfinite(scheme.time_step)) || scheme.partners < 1) {
    throw std::invalid_argument("time step and number of partners must be positive");
  }
  const auto particles = static_cast<std::uint64_t>(gas.particles());
  const StepEnds steps(scheme.time_step, time);
  const int useful = static_cast<int>(
      std::min(static_cast<std::uint64_t>(threads), 1 + particles / kFewestPerThread));
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
    if (keeps_on && !keeps_on(gas)) {
      return;
    }
  }
}

}  // namespace clca::boltzmann
