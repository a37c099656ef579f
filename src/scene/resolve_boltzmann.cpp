// A scene of the Boltzmann equation back to text.

#include <fmt/format.h>

#include "clca/boltzmann/law.hpp"
#include "clca/scene/resolve.hpp"
#include "scene/names.hpp"
#include "scene/resolve_text.hpp"

namespace clca::scene {

namespace {

std::string number(double value) {
  return fmt::format("{}", value);
}

std::string contact_lines(const BoltzmannScene& scene) {
  const bool slides = scene.friction != boltzmann::kNoSlidingLimit;
  return fmt::format("  restitution: {}\n{}  roughness: {}\n",
                     scene.lists_restitutions ? list(scene.restitutions, number)
                                              : number(scene.restitutions.front()),
                     slides ? fmt::format("  friction: {}\n", scene.friction) : "",
                     scene.roughness);
}

std::string scheme_lines(const BoltzmannScene& scene) {
  const auto name = name_of(kSchemeNames, scene.scheme.index());
  const auto* steps = std::get_if<boltzmann::OgawaKato>(&scene.scheme);
  return steps == nullptr ? fmt::format("  scheme: {}\n  shear_rate: {}\n", name, scene.shear_rate)
                          : fmt::format("  scheme: {}\n  time_step: {}\n  partners: {}\n", name,
                                        steps->time_step, steps->partners);
}

std::string bins_text(const QuantileBins& bins) {
  return fmt::format("q{}", bins.count);
}
std::string bins_text(const UniformBins& bins) {
  return fmt::format("{{width: {}, end: {}}}", bins.width, bins.end);
}

}  // namespace

std::string to_yaml(const BoltzmannScene& scene) {
  std::string text =
      fmt::format("clca: 1\ntitle: {}\nseed: {}\n\n", scene::quoted(scene.title), scene.seed);
  text += fmt::format(
      "boltzmann:\n  particles: {}\n  initial: {}\n  exact_moments: {}\n  sampling: {}\n",
      scene.particles, name_of(kInitialNames, scene.initial), scene.exact_moments,
      name_of(kSamplingNames, scene.quasi));
  text += contact_lines(scene);
  text += fmt::format("  energy_ratio: {}\n", scene.energy_ratio);
  text += scheme_lines(scene);
  text += fmt::format("  until: {}\n  ensemble: {}\n", scene.until, scene.ensemble);
  return text +
         fmt::format(
             "\noutput:\n  series: {{every: {}}}\n  histograms: {}\n  bins: {}\n  checkpoint: {}\n",
             scene.series_every, list(scene.histograms, number),
             std::visit([](const auto& bins) { return bins_text(bins); }, scene.bins),
             checkpoint_text(scene.checkpoint));
}

}  // namespace clca::scene
