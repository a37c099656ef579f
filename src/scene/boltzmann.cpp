#include "clca/scene/boltzmann.hpp"

#include <algorithm>
#include <cmath>

#include "clca/scene/resolve.hpp"

namespace clca::scene {

boltzmann::InitialCondition initial_condition(const BoltzmannScene& scene) {
  return {.particles = scene.particles,
          .initial = scene.initial,
          .energy_ratio = scene.energy_ratio,
          .exact_moments = scene.exact_moments,
          .quasi = scene.quasi};
}

boltzmann::Process process(const BoltzmannScene& scene, double restitution) {
  return {
      .law = {.restitution = restitution, .friction = scene.friction, .roughness = scene.roughness},
      .scheme = scene.scheme,
      .shear_rate = scene.shear_rate};
}

namespace {

constexpr double kMotionBytes = 6 * sizeof(double);
constexpr double kScratchBytes = 8;
constexpr double kOrderBytes = 16;
// Kept for each gas of the ensemble until the end, and as the text of a table.
constexpr double kRowBytes = 256;
constexpr double kRowTextBytes = 512;
constexpr double kBinBytes = 16;
constexpr double kBinTextBytes = 128;

double table_bytes(const BoltzmannScene& scene) {
  const double rows = scene.until / scene.series_every + 2;
  const auto* uniform = std::get_if<UniformBins>(&scene.bins);
  const double bins = uniform != nullptr ? std::ceil(uniform->end / uniform->width) + 1
                                         : std::get<QuantileBins>(scene.bins).count;
  const double shares = static_cast<double>(scene.histograms.size()) * bins;
  const auto gases = static_cast<double>(scene.ensemble);
  return static_cast<double>(scene.restitutions.size()) *
         ((kRowBytes * gases + kRowTextBytes) * rows +
          (kBinBytes * gases + kBinTextBytes) * shares);
}

/// While a checkpoint is written there are, of all that is in it, its columns, the file and the
/// bytes that go to the disk.
constexpr double kSavedCopies = 3;

}  // namespace

double retained_gas_bytes(const BoltzmannScene& scene) {
  constexpr double kMaxBytes = 1024.0 * 1024 * 1024;
  const double bytes = kMotionBytes * static_cast<double>(scene.particles) *
                       static_cast<double>(scene.ensemble) *
                       static_cast<double>(scene.restitutions.size());
  return scene.checkpoint && bytes <= kMaxBytes ? bytes : 0;
}

double bytes_of(const BoltzmannScene& scene, int threads) {
  const auto members = static_cast<double>(
      std::min(scene.ensemble, static_cast<std::uint64_t>(std::max(1, threads))));
  // There are two copies: at first the sample that a gas is made from, with the literal scheme the
  // state before a step.
  double per_particle = 2 * kMotionBytes + kScratchBytes;
  if (scene.quasi && std::holds_alternative<boltzmann::OgawaKato>(scene.scheme)) {
    per_particle += kMotionBytes + kOrderBytes;  // it is sorted
  }
  const double saved = kSavedCopies * kMotionBytes;
  // A checkpoint goes to the disk while the gases go on; a run that is stopped has no more need of
  // the second copy.
  per_particle =
      scene.checkpoint ? per_particle + saved : std::max(per_particle, saved + kMotionBytes);
  return members * per_particle * static_cast<double>(scene.particles) +
         (1 + kSavedCopies) * retained_gas_bytes(scene) + table_bytes(scene);
}

}  // namespace clca::scene
