// What leaves in a stage, as a whole and by outlet and species.

#include <algorithm>
#include <functional>
#include <numeric>

#include "clca/measure/outflow.hpp"
#include "clca/scene/units.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

using Named = std::vector<store::NamedMeasure>;

/// False with so many outlets and species that run.json would have too many measures.
bool has_values_of_each(const scene::Scene& scene) {
  constexpr std::size_t kMostMeasures = 800;
  // Besides those of its species.
  const std::size_t of_outlet = scene::has_density(scene) ? 6 : 4;
  return scene.outlets.size() * (scene.species.size() + of_outlet) <= kMostMeasures;
}

constexpr Quantity kPerStep = {"outflow_sites_per_step", "Outflow", "sites/step",
                               "steady part: while 20 % to 70 % of what left the box left"};
constexpr std::string_view kSteady = "steady part, as `outflow_sites_per_step`";
constexpr Quantity kPerTime = {"outflow_sites_per_time", "Outflow over time", "sites/time",
                               kSteady};
constexpr Quantity kMassPerTime = {"outflow_mass_per_time", "Mass outflow", "kg/s", kSteady};
constexpr Quantity kParticlesPerTime = {
    "outflow_particles_per_time", "Particle outflow", "particles/s",
    "`outflow_mass_per_time` over the mean mass of a particle that left"};
constexpr Quantity kClogged = {"clogged", "Clogged", "",
                               "at rest, particles hang over an outlet that they could have "
                               "passed; some outlet, if there are several"};

using Rates = std::vector<std::pair<Quantity, double>>;

/// The rates that the units of the scene allow.
Rates rates(const scene::Scene& scene, const measure::Outflow& outflow) {
  const double per_step = outflow.sites_per_step();
  Rates all = {{kPerStep, per_step}};
  if (const auto conversion = scene::unit_conversion(scene)) {
    const double per_time = per_step / conversion->time_step;
    all.emplace_back(kPerTime, per_time);
    if (conversion->site_mass) {
      const measure::Discharge left = outflow.stage_discharge();
      const double sites =
          left.particles > 0 ? static_cast<double>(left.sites) / static_cast<double>(left.particles)
                             : 1;
      all.emplace_back(kMassPerTime, conversion->mass_rate(per_step));
      all.emplace_back(kParticlesPerTime, per_time / sites);
    }
  }
  return all;
}

/// `count` rates of all outlets together, from `first` on, if the scene has them.
template <std::size_t kFirst, std::size_t kCount>
MeasureValues some_rates(const StageView& stage) {
  const Rates all = rates(stage.scene, stage.history.outflow);
  MeasureValues values;
  for (std::size_t i = kFirst; i < std::min(kFirst + kCount, all.size()); ++i) {
    values.emplace_back(all[i].second);
  }
  return values;
}

/// Whether each outlet is clogged.
std::vector<bool> clogged(const StageView& stage) {
  const model::SceneModel& model = stage.model;
  std::vector<bool> clogged;
  for (std::size_t outlet = 0; outlet < model.state().outlets.size(); ++outlet) {
    clogged.push_back(stage.history.ended_at_rest &&
                      measure::is_clogged(model.state(), model.grains().occupancy(), outlet,
                                          model.grains().down()));
  }
  return clogged;
}

MeasureValues discharged(const StageView& stage) {
  if (stage.model.state().outlets.empty()) {
    return {};
  }
  const std::vector<bool> outlets = clogged(stage);
  return {static_cast<double>(stage.history.outflow.stage_discharge().particles),
          stage.history.discharged_share(), std::ranges::find(outlets, true) != outlets.end()};
}

std::string name_of(const Quantity& quantity, const scene::Outlet& outlet) {
  return std::string(quantity.key) + "." + outlet.name;
}

Named discharged_of_each(const StageView& stage) {
  const grains::State& state = stage.model.state();
  const scene::Scene& scene = stage.scene;
  Named results;
  if (state.outlets.empty() || !has_values_of_each(scene)) {
    return results;
  }
  std::vector<std::uint64_t> particles = measure::discharged_counts(state, scene.species.size());
  std::transform(particles.begin(), particles.end(), stage.history.discharged_at_start.begin(),
                 particles.begin(), std::minus<>());
  for (const auto& [name, count] : discharge_by_name(scene, particles)) {
    results.emplace_back(name, static_cast<double>(count));
  }
  const std::vector<bool> outlets = clogged(stage);
  for (std::size_t outlet = 0; outlets.size() > 1 && outlet < outlets.size(); ++outlet) {
    const scene::Outlet& named = scene.outlets[outlet];
    for (const auto& [quantity, rate] : rates(scene, stage.history.outlets[outlet])) {
      results.emplace_back(name_of(quantity, named), rate);
    }
    results.emplace_back(name_of(kClogged, named), bool{outlets[outlet]});
  }
  return results;
}

}  // namespace

/// Names of the measures of single outlets, also where there is only one.
std::vector<std::string> names_by_outlet(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, none] : discharge_by_name(scene)) {
    names.push_back(name);
  }
  if (scene.outlets.size() == 1) {
    names.push_back("discharged." + scene.outlets.front().name);
  }
  if (has_values_of_each(scene)) {
    for (const scene::Outlet& outlet : scene.outlets) {
      for (const auto& [quantity, none] : rates(scene, {})) {
        names.push_back(name_of(quantity, outlet));
      }
      names.push_back(name_of(kClogged, outlet));
    }
  }
  return names;
}

std::vector<std::pair<std::string, std::uint64_t>> discharge_by_name(
    const scene::Scene& scene, std::vector<std::uint64_t> particles) {
  std::vector<std::pair<std::string, std::uint64_t>> all;
  particles.resize(scene.outlets.size() * scene.species.size());
  auto count = particles.begin();
  for (std::size_t i = 0; i < scene.outlets.size() && has_values_of_each(scene); ++i) {
    const std::string name = "discharged." + scene.outlets[i].name;
    const auto end = std::next(count, static_cast<std::ptrdiff_t>(scene.species.size()));
    if (scene.outlets.size() > 1) {
      all.emplace_back(name, std::accumulate(count, end, std::uint64_t{0}));
    }
    for (std::size_t of = 0; scene.species.size() > 1 && of < scene.species.size(); ++of) {
      all.emplace_back(name + "." + scene.species[of].name, count[static_cast<std::ptrdiff_t>(of)]);
    }
    count = end;
  }
  return all;
}

std::vector<QuantityGroup> outflow_quantities() {
  using scene::Measure;
  return {{Measure::outflow, "", {kPerStep}, some_rates<0, 1>},
          {Measure::outflow, "model `contact`", {kPerTime}, some_rates<1, 1>},
          {Measure::outflow,
           "with `units.density`",
           {kMassPerTime, kParticlesPerTime},
           some_rates<2, 2>},
          {Measure::outflow,
           "with outlets",
           {{"discharged", "Discharged", "particles", "through an outlet, in the stage"},
            {"discharged_share", "Share discharged", "",
             "of the particles, through outlets, in the stage"},
            kClogged},
           discharged,
           discharged_of_each}};
}

}  // namespace clca::record
