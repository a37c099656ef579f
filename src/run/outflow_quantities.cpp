// What leaves in a stage, as a whole and by outlet and species.

#include <algorithm>
#include <functional>

#include "clca/measure/clogging.hpp"
#include "clca/scene/units.hpp"
#include "run/outlet_counts.hpp"
#include "run/quantities.hpp"

namespace clca::run {

namespace {

using Values = std::vector<store::MeasureValue>;
using Named = std::vector<store::NamedMeasure>;

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
