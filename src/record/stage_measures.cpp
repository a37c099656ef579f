// The measures that a scene asks for, taken at the end of a stage.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "clca/document/document.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/measure/mixing.hpp"
#include "clca/measure/profile.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/output.hpp"
#include "clca/scene/parse.hpp"
#include "clca/text/message.hpp"
#include "record/internal/cycle_record.hpp"
#include "record/internal/quantities.hpp"

namespace clca::record {

namespace {

constexpr std::string_view kFlank =
    "straight line through the surface between 15 % and 80 % of its height";

MeasureValues values_of(const measure::ReposeAngle& angle) {
  return {store::value_or_null(angle.mean_degrees()), store::value_or_null(angle.left.degrees),
          store::value_or_null(angle.right.degrees)};
}

/// Empty in a periodic box.
measure::ReposeAngle repose_in_gravity(const model::SceneModel& model) {
  if (model.state().lattice.periodic()) {
    return {};
  }
  return measure::repose_angle(
      measure::surface_profile(model.state(), contact::gravity_direction(model.vessel())));
}

MeasureValues axis_order(const StageView& stage) {
  if (stage.scene.model != scene::Model::baxter) {
    return {};
  }
  return {store::value_or_null(measure::axis_order(stage.model.state()))};
}

std::vector<QuantityGroup> made_groups() {
  using scene::Measure;
  std::vector<QuantityGroup> groups = {
      {Measure::repose,
       "",
       {kReposeAngle,
        {"repose_left_deg", "Slope, left flank", "degrees", kFlank, true},
        {"repose_right_deg", "Slope, right flank", "degrees", "as `repose_left_deg`", true}},
       [](const StageView& stage) -> MeasureValues {
         return values_of(measure::repose_angle(measure::surface_profile(stage.model.state())));
       }},
      {Measure::repose,
       "with a [vessel](#vessel), not in a periodic box",
       {kReposeGravity,
        {"repose_gravity_left_deg", "Slope against gravity, left flank", "degrees", kFlank},
        {"repose_gravity_right_deg", "Slope against gravity, right flank", "degrees",
         "as `repose_gravity_left_deg`"}},
       [](const StageView& stage) -> MeasureValues {
         return model::has_vessel(stage.scene) && !stage.model.state().lattice.periodic()
                    ? values_of(repose_in_gravity(stage.model))
                    : MeasureValues{};
       }},
      {Measure::runout,
       "",
       {{"runout_99", "Run-out of 99 %", "spacings",
         "how far the 99th percentile of its sites lies beyond its origins", true},
        {"runout_front", "Run-out of the front", "spacings",
         "how far the outermost site lies beyond the origins", true}},
       [](const StageView& stage) -> MeasureValues {
         const auto runout = measure::runout(stage.model.state());
         return runout ? MeasureValues{runout->percentile_99, runout->front} : MeasureValues(2);
       }},
      {Measure::packing,
       "",
       {{"packing_fraction", "Packing fraction", "",
         "sites of particles over the sites that the bed could fill"},
        kHeightMean},
       [](const StageView& stage) -> MeasureValues {
         const grains::State& state = stage.model.state();
         return {store::value_or_null(measure::packing_fraction(state)),
                 store::value_or_null(bed_height(measure::surface_profile(state)))};
       }},
      {Measure::moved,
       "",
       {{"moved_share", "Share moved", "",
         "of the particles, by more than the smallest diameter from where the stage began"},
        {"moved_share_2", "Share moved, 2 spacings", "", "by more than 2 spacings"}},
       [](const StageView& stage) -> MeasureValues {
         const grains::State& state = stage.model.state();
         return {store::value_or_null(
                     measure::moved_share(state, measure::smallest_kind_diameter(state))),
                 store::value_or_null(measure::moved_share(state, 2))};
       }}};
  const auto add = [&groups](std::vector<QuantityGroup> more) {
    groups.insert(groups.end(), more.begin(), more.end());
  };
  add(outflow_quantities());
  add(force_quantities());
  add({{Measure::segregation,
        "several species",
        {kSegregationIndex, kLaceyIndex},
        [](const StageView& stage) -> MeasureValues {
          if (stage.scene.species.size() < 2) {
            return {};
          }
          const grains::State& state = stage.model.state();
          return {store::value_or_null(measure::segregation_index(state)),
                  store::value_or_null(measure::lacey_index(
                      state, stage.observers.find<CycleRecord>()->cell_side()))};
        }},
       {Measure::intruder,
        "a single particle of a species",
        {kIntruderHeight},
        [](const StageView& stage) -> MeasureValues {
          const auto height = measure::intruder_height(stage.model.state());
          return height ? MeasureValues{*height} : MeasureValues{};
        }},
       {Measure::axis_order,
        "with `model: baxter`",
        {{"axis_order", "Order of axes", "",
          "share of the pairs of neighbouring grains with the same axis; a third at random"}},
        axis_order},
       {{},
        "with a [vessel](#vessel)",
        {kVesselAngle},
        [](const StageView& stage) -> MeasureValues {
          return model::has_vessel(stage.scene)
                     ? MeasureValues{contact::to_degrees(stage.model.vessel().angle)}
                     : MeasureValues{};
        }}});
  for (const ObserverFactory& kind : observer_factories()) {
    add(kind.quantities);
  }
  return groups;
}

/// Adds those of one measure, or those that no measure asks for.
void add(std::vector<store::NamedMeasure>& results, const std::optional<scene::Measure>& measure,
         const StageView& stage) {
  for (const QuantityGroup& group : stage_quantities()) {
    if (group.measure != measure) {
      continue;
    }
    const MeasureValues values = group.values(stage);
    if (!values.empty() && values.size() != group.quantities.size()) {
      throw std::logic_error(fmt::format("the group of {} has {} values for {} quantities",
                                         group.quantities.front().key, values.size(),
                                         group.quantities.size()));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      results.emplace_back(group.quantities[i].key, values[i]);
    }
    if (group.values_of_each != nullptr) {
      const auto values_of_each = group.values_of_each(stage);
      results.insert(results.end(), values_of_each.begin(), values_of_each.end());
    }
  }
}

/// What tables of sweeps have of each stage besides the measures.
constexpr std::string_view kSteps = "steps";
constexpr std::string_view kTime = "time";

/// The measures that expressions of the scene may name.
std::vector<std::string> named_measures(const scene::Scene& scene) {
  std::vector<std::string> names = {std::string(kSteps), std::string(kTime)};
  for (const QuantityGroup& group : stage_quantities()) {
    if (!group.measure || requests_measure(scene, *group.measure)) {
      for (const Quantity& quantity : group.quantities) {
        names.emplace_back(quantity.key);
      }
    }
  }
  if (requests_measure(scene, scene::Measure::outflow)) {
    std::ranges::move(names_by_outlet(scene), std::back_inserter(names));
  }
  return names;
}

/// The measure under which a quantity is requested, if there is one.
std::optional<scene::Measure> measure_of(std::string_view name) {
  for (const QuantityGroup& group : stage_quantities()) {
    if (std::ranges::find(group.quantities, name, &Quantity::key) != group.quantities.end()) {
      return group.measure;
    }
  }
  return std::nullopt;
}

/// Adds what the scene derives from them.
void add_derived(std::vector<store::NamedMeasure>& results, const StageView& stage) {
  std::map<std::string, double, std::less<>> numbers;
  const auto note = [&numbers](const store::NamedMeasure& measure) {
    if (const auto* number = std::get_if<double>(&measure.second)) {
      numbers.emplace(measure.first, *number);
    } else if (const auto* answer = std::get_if<bool>(&measure.second)) {
      numbers.emplace(measure.first, *answer ? 1 : 0);
    }
  };
  note({std::string(kSteps), static_cast<double>(stage.history.steps)});
  if (const auto conversion = scene::unit_conversion(stage.scene)) {
    note({std::string(kTime), conversion->time(stage.history.steps)});
  }
  std::ranges::for_each(results, note);
  const auto number_of = [&](std::string_view name) -> std::optional<double> {
    auto found = numbers.find(name);
    if (found == numbers.end() && stage.scene.outlets.size() == 1) {
      const std::string of = "." + stage.scene.outlets.front().name;  // as all outlets together
      found = name.ends_with(of) ? numbers.find(name.substr(0, name.size() - of.size())) : found;
    }
    return found != numbers.end() && std::isfinite(found->second) ? std::optional(found->second)
                                                                  : std::nullopt;
  };
  for (const scene::DerivedMeasure& derived : stage.scene.derived_measures) {
    results.emplace_back(derived.name, store::value_or_null(document::expression_value(
                                           derived.expression, number_of)));
    note(results.back());
  }
}

/// Adds what has left to the outflow of all outlets and of each.
void add_discharge(StageHistory& history, const grains::State& state,
                   void (measure::Outflow::*add)(measure::Discharge)) {
  (history.outflow.*add)(measure::discharge(state));
  for (std::size_t outlet = 0; outlet < history.outlets.size(); ++outlet) {
    (history.outlets[outlet].*add)(measure::discharge(state.outlets[outlet]));
  }
}

}  // namespace

const std::vector<QuantityGroup>& stage_quantities() {
  static const std::vector<QuantityGroup> kGroups = made_groups();
  return kGroups;
}

StageHistory::StageHistory(const scene::Scene& scene, const grains::State& state)
    : outflow(measure::discharge(state)),
      discharged_at_start(measure::discharged_counts(state, scene.species.size())) {
  for (const grains::Outlet& outlet : state.outlets) {
    outlets.emplace_back(measure::discharge(outlet));
  }
}

void StageHistory::begin(const grains::State& state) {
  add_discharge(*this, state, &measure::Outflow::add_at_start);
  profile_at_start = measure::surface_profile(state);
  particles_at_start = grains::present_count(state) + outflow.stage_discharge().particles;
}

void StageHistory::add_step(const grains::StepReport& report, const grains::State& state) {
  ++steps;
  is_at_rest = report.settled;
  emitted += report.emitted_count;
  add_discharge(*this, state, &measure::Outflow::add);
}

double StageHistory::discharged_share() const {
  const auto all = static_cast<double>(particles_at_start + emitted);
  return all > 0 ? static_cast<double>(outflow.stage_discharge().particles) / all : 0;
}

std::vector<store::NamedMeasure> stage_measures(const StageView& stage) {
  std::vector<std::optional<scene::Measure>> wanted(stage.scene.measures.begin(),
                                                    stage.scene.measures.end());
  wanted.emplace_back();  // those that no measure asks for
  std::vector<store::NamedMeasure> results;
  for (const auto& measure : wanted) {
    add(results, measure, stage);
  }
  if (!stage.scene.derived_measures.empty()) {
    add_derived(results, stage);
  }
  return results;
}

void check_derived(const scene::Scene& scene) {
  std::vector<std::string> known = named_measures(scene);
  const auto is_known = [&known](std::string_view name) {
    return std::ranges::count(known, name) > 0;
  };
  for (const scene::DerivedMeasure& derived : scene.derived_measures) {
    const auto refuse = [&derived](const std::string& why) {
      throw scene::SceneError(
          fmt::format("{}: error: measure.{}: {}", derived.location, derived.name, why));
    };
    if (find_quantity(derived.name) != nullptr) {
      refuse("there is a quantity of this name; give it another one");
    }
    for (const std::string& name : document::names_in(derived.expression, is_known)) {
      if (!is_known(name)) {
        const std::vector<std::string_view> names(known.begin(), known.end());
        const auto of = measure_of(name);
        refuse(fmt::format("unknown measure {} in {}{}", text::quoted(name),
                           text::quoted(derived.expression),
                           of ? fmt::format("; it comes with {}, so name that under measure, too",
                                            scene::name_of_measure(*of))
                              : text::suggestion(name, names)));
      }
    }
    known.push_back(derived.name);
  }
}

std::vector<store::NamedMeasure> stage_measures(scene::Measure wanted, const StageView& stage) {
  std::vector<store::NamedMeasure> results;
  add(results, wanted, stage);
  return results;
}

std::vector<std::string> measure_notes(const scene::Scene& scene, const model::SceneModel& model) {
  std::vector<std::string> notes;
  if (requests_measure(scene, scene::Measure::runout)) {
    const auto runout = measure::runout(model.state());
    if (runout && runout->reaches_side) {
      notes.emplace_back(
          "runout_99 and runout_front: grains have come to a side of the box, which ends the "
          "run-out; a wider box lets them go on");
    }
  }
  const auto add = [&](const std::string& name, bool uneven) {
    if (uneven) {
      notes.push_back(name + " is null: the surface there has no single slope");
    }
  };
  if (!requests_measure(scene, scene::Measure::repose)) {
    return notes;
  }
  const auto angle = measure::repose_angle(measure::surface_profile(model.state()));
  add("repose_left_deg", angle.left.is_uneven);
  add("repose_right_deg", angle.right.is_uneven);
  if (model::has_vessel(scene)) {
    const auto in_gravity = repose_in_gravity(model);
    add("repose_gravity_left_deg", in_gravity.left.is_uneven);
    add("repose_gravity_right_deg", in_gravity.right.is_uneven);
  }
  return notes;
}

}  // namespace clca::record
