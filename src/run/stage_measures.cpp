#include "run/stage_measures.hpp"

#include <algorithm>

#include "clca/measure/displacement.hpp"
#include "clca/measure/profile.hpp"
#include "clca/measure/segregation.hpp"
#include "clca/store/table.hpp"
#include "run/quantities.hpp"

namespace clca::run {

namespace {

using Values = std::vector<store::MeasureValue>;

constexpr std::string_view kFlank =
    "straight line through the surface between 15 % and 80 % of its height";
constexpr std::string_view kFlanks = "mean of the flanks that are there";

Values values_of(const measure::ReposeAngle& angle) {
  return {store::value_or_null(angle.mean()), store::value_or_null(angle.left),
          store::value_or_null(angle.right)};
}

Values repose(const StageView& stage) {
  return values_of(measure::repose_angle(measure::surface_profile(stage.model.state())));
}

Values vessel_angle(const StageView& stage) {
  return has_vessel(stage.scene) ? Values{contact::degrees(stage.model.vessel().angle)} : Values{};
}

/// Empty in a periodic box.
measure::ReposeAngle repose_in_gravity(const Model& model) {
  if (model.state().lattice.periodic()) {
    return {};
  }
  return measure::repose_angle(
      measure::surface_profile(model.state(), contact::gravity_direction(model.vessel())));
}

Values repose_gravity(const StageView& stage) {
  return has_vessel(stage.scene) && !stage.model.state().lattice.periodic()
             ? values_of(repose_in_gravity(stage.model))
             : Values{};
}

Values runout(const StageView& stage) {
  const auto runout = measure::runout(stage.model.state());
  return runout ? Values{runout->percent_99, runout->front} : Values(2);
}

Values packing(const StageView& stage) {
  const grains::State& state = stage.model.state();
  return {store::value_or_null(measure::packing_fraction(state)),
          measure::mean_height(measure::surface_profile(state))};
}

Values moved(const StageView& stage) {
  const grains::State& state = stage.model.state();
  return {measure::moved_share(state, measure::smallest_diameter(state)),
          measure::moved_share(state, 2)};
}

Values segregation(const StageView& stage) {
  if (stage.scene.species.size() < 2) {
    return {};
  }
  const grains::State& state = stage.model.state();
  return {store::value_or_null(measure::segregation_index(state)),
          store::value_or_null(measure::lacey_index(state, stage.records.cycles().cell()))};
}

Values intruder(const StageView& stage) {
  const auto height = measure::intruder_height(stage.model.state());
  return height ? Values{*height} : Values{};
}

Values convection(const StageView& stage) {
  const measure::Convection* convection = stage.records.cycles().convection();
  if (convection == nullptr) {
    return {};
  }
  const auto rolls = convection->rolls();
  return rolls ? Values{rolls->centre_minus_wall, rolls->circulation_left, rolls->circulation_right}
               : Values(3);
}

Values mixing(const StageView& stage) {
  const std::vector<measure::FallenPairs>& fallen = stage.records.mixing()->fallen();
  const auto at = [&](std::size_t diameters, double (measure::FallenPairs::*value)() const) {
    return diameters <= fallen.size() ? store::MeasureValue((fallen[diameters - 1].*value)())
                                      : store::MeasureValue();
  };
  return {at(1, &measure::FallenPairs::kept_share), at(10, &measure::FallenPairs::kept_share),
          at(5, &measure::FallenPairs::diffusion)};
}

Values fluctuations(const StageView& stage) {
  if (!stage.records.fields()) {
    return {};
  }
  const FieldRecord& fields = *stage.records.fields();
  const measure::Fluctuations& fluctuations = fields.fluctuations();
  const auto distance = [&](const std::vector<double>& shares) {
    const auto reference = statistics::chi_square_shares(fluctuations.bins(), 2);
    return fluctuations.samples() > 0
               ? store::MeasureValue(statistics::hellinger_distance(shares, reference))
               : store::MeasureValue();
  };
  return {fields.fluctuation_energy(),           distance(fluctuations.shares()),
          distance(fluctuations.local_shares()), static_cast<double>(fluctuations.samples()),
          fluctuations.resting_share(),          fluctuations.sparse_share()};
}

Values energy_growth(const StageView& stage) {
  const auto& energy = stage.records.energy();
  const auto growth = energy ? energy->growth() : std::nullopt;
  return growth ? Values{*growth} : Values{};
}

std::vector<QuantityGroup> made_groups() {
  using scene::Measure;
  std::vector<QuantityGroup> groups = {
      {Measure::repose,
       "",
       {{"repose_angle_deg", "Slope", "degrees", kFlanks},
        {"repose_left_deg", "Slope, left flank", "degrees", kFlank},
        {"repose_right_deg", "Slope, right flank", "degrees", "the same on the other side"}},
       repose},
      {Measure::repose, "with a [vessel](#vessel)", {kVesselAngle}, vessel_angle},
      {Measure::repose,
       "with a [vessel](#vessel), not in a periodic box",
       {{"repose_gravity_deg", "Slope against gravity", "degrees",
         "mean of the flanks that are there, where gravity points down; all others are in the "
         "frame of the vessel"},
        {"repose_gravity_left_deg", "Slope against gravity, left flank", "degrees", kFlank},
        {"repose_gravity_right_deg", "Slope against gravity, right flank", "degrees",
         "the same on the other side"}},
       repose_gravity},
      {Measure::runout,
       "",
       {{"runout_99", "Run-out of 99 %", "spacings",
         "how far the 99th percentile of its sites lies beyond its origins"},
        {"runout_front", "Run-out of the front", "spacings",
         "how far the outermost site lies beyond the origins"}},
       runout},
      {Measure::packing,
       "",
       {{"packing_fraction", "Packing fraction", "",
         "sites of particles over the sites that the bed could fill"},
        {"height_mean", "Mean height", "spacings",
         "of the surface, over the columns with particles"}},
       packing},
      {Measure::moved,
       "",
       {{"moved_share", "Share moved", "",
         "of the particles, by more than the smallest diameter from where the stage began"},
        {"moved_share_2", "Share moved, 2 spacings", "", "by more than 2 spacings"}},
       moved}};
  const auto add = [&groups](std::vector<QuantityGroup> more) {
    groups.insert(groups.end(), more.begin(), more.end());
  };
  add(outflow_quantities());
  add(force_quantities());
  add({{Measure::segregation,
        "several species",
        {{"segregation_index", "Segregation index", "",
          "height of the large ones over the small ones, over half the bed"},
         {"lacey_index", "Lacey’s index of mixing", "", "0 separated, 1 as random"}},
        segregation},
       {Measure::intruder,
        "a single particle of a species",
        {{"intruder_height_rel", "Height of the intruder", "",
          "0 on the floor, 1 just buried at the top"}},
        intruder},
       {Measure::convection,
        "a wall with a wave or shake",
        {{"convection_centre_minus_wall", "Convection, centre less walls", "spacings/cycle",
          "rise inside less that at the walls"},
         {"convection_circulation_left", "Circulation, left half", "rad/cycle", "anticlockwise"},
         {"convection_circulation_right", "Circulation, right half", "rad/cycle", "anticlockwise"}},
        convection},
       {Measure::mixing,
        "",
        {{"neighbours_kept_1", "Neighbours kept, 1 d", "",
          "share still neighbours when they have fallen one mean diameter"},
         {"neighbours_kept_10", "Neighbours kept, 10 d", "", "after ten"},
         {"pair_diffusion_5", "Diffusion of pairs", "spacings",
          "⟨(Δx₁ - Δx₂)²⟩ over 4 times the distance fallen, at five mean diameters"}},
        mixing},
       {{},
        "`output.fields`",
        {{"fluctuation_energy", "Energy of fluctuations", "(spacings/step)²",
          "½⟨|v - ⟨v⟩|²⟩, mean over cells and windows"},
         {"fluctuation_hellinger", "Distance from chi-square", "",
          "of the distribution of the fluctuations (Hellinger), over the mean of the window"},
         {"fluctuation_hellinger_local", "Distance from chi-square, local", "",
          "the same, over the mean of the cell"},
         {"fluctuation_samples", "Samples of fluctuations", "", "particles × windows"},
         {"fluctuation_resting_share", "Left out: resting", "",
          "in cells that rest or move as one"},
         {"fluctuation_sparse_share", "Left out: sparse", "",
          "in cells of fewer than 5 particles"}},
        fluctuations},
       {{},
        "model `contact`, without sources",
        {{"energy_growth", "Growth of the energy", "",
          "most that it has grown in the stage, as a share of that at its start"}},
        energy_growth}});
  return groups;
}

/// Adds those of one measure, or those that no measure asks for.
void add(std::vector<store::NamedMeasure>& results, const std::optional<scene::Measure>& measure,
         const StageView& stage) {
  for (const QuantityGroup& group : stage_quantities()) {
    if (group.measure != measure) {
      continue;
    }
    const Values values = group.values(stage);
    for (std::size_t i = 0; i < values.size(); ++i) {
      results.emplace_back(group.quantities[i].key, values[i]);
    }
    if (group.apart != nullptr) {
      const auto apart = group.apart(stage);
      results.insert(results.end(), apart.begin(), apart.end());
    }
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
      discharged_at_start(measure::discharged_particles(state, scene.species.size())) {
  for (const grains::Outlet& outlet : state.outlets) {
    outlets.emplace_back(measure::discharge(outlet));
  }
}

void StageHistory::begin(const grains::State& state) {
  add_discharge(*this, state, &measure::Outflow::add_at_start);
  profile_at_start = measure::surface_profile(state);
  particles_at_start = grains::present_count(state) + outflow.during_stage().particles;
}

void StageHistory::add_step(const grains::StepReport& report, const grains::State& state) {
  ++steps;
  resting = report.settled;
  emitted += report.emitted;
  add_discharge(*this, state, &measure::Outflow::add);
}

double StageHistory::discharged_share() const {
  const auto all = static_cast<double>(particles_at_start + emitted);
  return all > 0 ? static_cast<double>(outflow.during_stage().particles) / all : 0;
}

std::vector<store::NamedMeasure> stage_measures(const scene::Scene& scene, const Model& model,
                                                const StageHistory& history,
                                                const Records& records) {
  const StageView stage = {scene, model, history, records};
  std::vector<std::optional<scene::Measure>> wanted(scene.measures.begin(), scene.measures.end());
  wanted.emplace_back();  // those that no measure asks for
  std::vector<store::NamedMeasure> results;
  for (const auto& measure : wanted) {
    add(results, measure, stage);
  }
  return results;
}

std::vector<store::NamedMeasure> stage_measures(scene::Measure wanted, const scene::Scene& scene,
                                                const Model& model, const StageHistory& history,
                                                const Records& records) {
  std::vector<store::NamedMeasure> results;
  add(results, wanted, {scene, model, history, records});
  return results;
}

std::vector<std::string> slope_notes(const scene::Scene& scene, const Model& model) {
  std::vector<std::string> notes;
  const auto add = [&](const std::string& name, bool uneven) {
    if (uneven) {
      notes.push_back(name + " is null: the surface there has no single slope");
    }
  };
  const auto& wanted = scene.measures;
  if (std::find(wanted.begin(), wanted.end(), scene::Measure::repose) == wanted.end()) {
    return notes;
  }
  const auto angle = measure::repose_angle(measure::surface_profile(model.state()));
  add("repose_left_deg", angle.left_uneven);
  add("repose_right_deg", angle.right_uneven);
  if (has_vessel(scene)) {
    const auto in_gravity = repose_in_gravity(model);
    add("repose_gravity_left_deg", in_gravity.left_uneven);
    add("repose_gravity_right_deg", in_gravity.right_uneven);
  }
  return notes;
}

std::string mixing_table(const measure::Mixing& mixing) {
  store::Table table({"fallen_d", "fallen", "pairs", "kept", "pair_diffusion"});
  for (std::size_t i = 0; i < mixing.fallen().size(); ++i) {
    const measure::FallenPairs& row = mixing.fallen()[i];
    table.add_row({static_cast<double>(i + 1), row.fallen / static_cast<double>(row.pairs),
                   row.pairs, row.kept_share(), row.diffusion()});
  }
  return table.to_csv();
}

std::string profile_table(const std::vector<double>& start, const std::vector<double>& end) {
  store::Table table({"x", "height_start", "height_end"});
  for (std::size_t column = 0; column < end.size(); ++column) {
    table.add_row(
        {lattice::kColumnPitch * static_cast<double>(column), start[column], end[column]});
  }
  return table.to_csv();
}

}  // namespace clca::run
