// What leaves in a stage, as a whole and by outlet and species.

#include <algorithm>
#include <functional>
#include <numeric>

#include "clca/measure/clogging.hpp"
#include "clca/scene/units.hpp"
#include "run/quantities.hpp"

namespace clca::run {

namespace {

using Values = std::vector<store::MeasureValue>;
using Named = std::vector<store::NamedMeasure>;

/// False with so many outlets and species that run.json would have too many measures.
bool counts_apart(const scene::Scene& scene) {
  constexpr std::size_t kMostMeasures = 800;
  constexpr std::size_t kMeasuresOfOutlet = 4;  // besides those of its species
  return scene.outlets.size() * (scene.species.size() + kMeasuresOfOutlet) <= kMostMeasures;
}

constexpr Quantity kPerStep = {"outflow_sites_per_step", "Outflow", "sites/step",
                               "steady part: while 20 % to 70 % of what left the box left"};
constexpr Quantity kPerTime = {"outflow_sites_per_time", "Outflow over time", "sites/time",
                               "the same"};
constexpr Quantity kClogged = {"clogged", "Clogged", "",
                               "at rest, particles hang over an outlet that they could have "
                               "passed; some outlet, if there are several"};

Values per_step(const StageView& stage) {
  return {stage.history.outflow.sites_per_step()};
}

std::optional<double> rate_over_time(const scene::Scene& scene, const measure::Outflow& outflow) {
  const auto conversion = scene::conversion(scene);
  return conversion ? std::optional(outflow.sites_per_step() / conversion->time_step)
                    : std::nullopt;
}

Values per_time(const StageView& stage) {
  const auto rate = rate_over_time(stage.scene, stage.history.outflow);
  return rate ? Values{*rate} : Values{};
}

/// Of each outlet.
std::vector<bool> clogged(const StageView& stage) {
  const Model& model = stage.model;
  std::vector<bool> clogged;
  for (std::size_t outlet = 0; outlet < model.state().outlets.size(); ++outlet) {
    clogged.push_back(
        stage.history.settled &&
        measure::clogged(model.state(), model.grains().occupancy(), outlet, model.grains().down()));
  }
  return clogged;
}

Values discharged(const StageView& stage) {
  if (stage.model.state().outlets.empty()) {
    return {};
  }
  const std::vector<bool> outlets = clogged(stage);
  return {static_cast<double>(stage.history.outflow.during_stage().particles),
          stage.history.discharged_share(),
          std::find(outlets.begin(), outlets.end(), true) != outlets.end()};
}

Named discharged_apart(const StageView& stage) {
  const grains::State& state = stage.model.state();
  const scene::Scene& scene = stage.scene;
  Named results;
  if (state.outlets.empty() || !counts_apart(scene)) {
    return results;
  }
  std::vector<std::uint64_t> particles = measure::discharged_particles(state, scene.species.size());
  std::transform(particles.begin(), particles.end(), stage.history.discharged_at_start.begin(),
                 particles.begin(), std::minus<>());
  const std::vector<std::string> names = discharge_names(scene);
  const std::vector<std::uint64_t> values = discharge_values(scene, particles);
  for (std::size_t i = 0; i < names.size(); ++i) {
    results.emplace_back(names[i], static_cast<double>(values[i]));
  }
  const std::vector<bool> outlets = clogged(stage);
  for (std::size_t outlet = 0; outlets.size() > 1 && outlet < outlets.size(); ++outlet) {
    const auto of = [&](const Quantity& quantity) {
      return std::string(quantity.key) + "." + scene.outlets[outlet].name;
    };
    const measure::Outflow& outflow = stage.history.outlets[outlet];
    results.emplace_back(of(kPerStep), outflow.sites_per_step());
    if (const auto rate = rate_over_time(scene, outflow)) {
      results.emplace_back(of(kPerTime), *rate);
    }
    results.emplace_back(of(kClogged), bool{outlets[outlet]});
  }
  return results;
}

}  // namespace

std::vector<std::string> discharge_names(const scene::Scene& scene) {
  std::vector<std::string> names;
  if (!counts_apart(scene)) {
    return names;
  }
  for (const scene::Outlet& outlet : scene.outlets) {
    const std::string name = "discharged." + outlet.name;
    if (scene.outlets.size() > 1) {
      names.push_back(name);
    }
    for (const scene::Species& species : scene.species) {
      if (scene.species.size() > 1) {
        names.push_back(name + "." + species.name);
      }
    }
  }
  return names;
}

std::vector<std::uint64_t> discharge_values(const scene::Scene& scene,
                                            const std::vector<std::uint64_t>& particles) {
  std::vector<std::uint64_t> values;
  const auto species = static_cast<std::ptrdiff_t>(scene.species.size());
  for (auto first = particles.begin(); first != particles.end(); first += species) {
    if (scene.outlets.size() > 1) {
      values.push_back(std::accumulate(first, first + species, std::uint64_t{0}));
    }
    if (species > 1) {
      values.insert(values.end(), first, first + species);
    }
  }
  return values;
}

std::vector<QuantityGroup> outflow_quantities() {
  using scene::Measure;
  return {{Measure::outflow, "", {kPerStep}, per_step},
          {Measure::outflow, "model `contact`", {kPerTime}, per_time},
          {Measure::outflow,
           "with outlets",
           {{"discharged", "Discharged", "particles", "through an outlet, in the stage"},
            {"discharged_share", "Share discharged", "",
             "of the particles, through outlets, in the stage"},
            kClogged},
           discharged,
           discharged_apart}};
}

}  // namespace clca::run
