#include "run/stage_measures.hpp"

#include <algorithm>
#include <functional>

#include "clca/measure/clogging.hpp"
#include "clca/measure/displacement.hpp"
#include "clca/measure/profile.hpp"
#include "clca/measure/segregation.hpp"
#include "clca/scene/units.hpp"
#include "clca/store/table.hpp"
#include "run/contact_tables.hpp"
#include "run/force_measures.hpp"
#include "run/outlet_counts.hpp"

namespace clca::run {

namespace {

using Results = std::vector<store::NamedMeasure>;

void add_repose(Results& results, const grains::State& state) {
  const auto angle = measure::repose_angle(measure::surface_profile(state));
  results.emplace_back("repose_angle_deg", store::value_or_null(angle.mean()));
  results.emplace_back("repose_left_deg", store::value_or_null(angle.left));
  results.emplace_back("repose_right_deg", store::value_or_null(angle.right));
}

/// Empty in a periodic box.
measure::ReposeAngle repose_in_gravity(const Model& model) {
  if (model.state().lattice.periodic()) {
    return {};
  }
  return measure::repose_angle(
      measure::surface_profile(model.state(), contact::gravity_direction(model.vessel())));
}

/// Of a vessel that is tilted or turned.
void add_repose_in_gravity(Results& results, const Model& model) {
  results.emplace_back("vessel_angle_deg", contact::degrees(model.vessel().angle));
  if (model.state().lattice.periodic()) {
    return;
  }
  const auto angle = repose_in_gravity(model);
  results.emplace_back("repose_gravity_deg", store::value_or_null(angle.mean()));
  results.emplace_back("repose_gravity_left_deg", store::value_or_null(angle.left));
  results.emplace_back("repose_gravity_right_deg", store::value_or_null(angle.right));
}

void add_runout(Results& results, const grains::State& state) {
  const auto runout = measure::runout(state);
  results.emplace_back("runout_99",
                       runout ? store::MeasureValue(runout->percent_99) : store::MeasureValue());
  results.emplace_back("runout_front",
                       runout ? store::MeasureValue(runout->front) : store::MeasureValue());
}

void add_packing(Results& results, const grains::State& state) {
  results.emplace_back("packing_fraction", store::value_or_null(measure::packing_fraction(state)));
  results.emplace_back("height_mean", measure::mean_height(measure::surface_profile(state)));
}

void add_moved(Results& results, const grains::State& state) {
  results.emplace_back("moved_share",
                       measure::moved_share(state, measure::smallest_diameter(state)));
  results.emplace_back("moved_share_2", measure::moved_share(state, 2));
}

/// `of`: ends the names.
void add_rate(Results& results, const std::string& of, const measure::Outflow& outflow,
              const std::optional<scene::Conversion>& conversion) {
  results.emplace_back("outflow_sites_per_step" + of, outflow.sites_per_step());
  if (conversion) {
    results.emplace_back("outflow_sites_per_time" + of,
                         outflow.sites_per_step() / conversion->time_step);
  }
}

/// Of each outlet and species, where there are several.
void add_outflow_apart(Results& results, const scene::Scene& scene, const Model& model,
                       const StageHistory& history, const std::vector<bool>& clogged) {
  const grains::State& state = model.state();
  std::vector<std::uint64_t> particles = measure::discharged_particles(state, scene.species.size());
  std::transform(particles.begin(), particles.end(), history.discharged_at_start.begin(),
                 particles.begin(), std::minus<>());
  const std::vector<std::string> names = discharge_names(scene);
  const std::vector<std::uint64_t> values = discharge_values(scene, particles);
  for (std::size_t i = 0; i < names.size(); ++i) {
    results.emplace_back(names[i], static_cast<double>(values[i]));
  }
  if (state.outlets.size() < 2) {
    return;
  }
  for (std::size_t outlet = 0; outlet < state.outlets.size(); ++outlet) {
    const std::string of = "." + scene.outlets[outlet].name;
    add_rate(results, of, history.outlets[outlet], scene::conversion(scene));
    results.emplace_back("clogged" + of, bool{clogged[outlet]});
  }
}

void add_outflow(Results& results, const scene::Scene& scene, const Model& model,
                 const StageHistory& history) {
  add_rate(results, "", history.outflow, scene::conversion(scene));
  const grains::State& state = model.state();
  if (state.outlets.empty()) {
    return;
  }
  std::vector<bool> clogged;
  for (std::size_t outlet = 0; outlet < state.outlets.size(); ++outlet) {
    clogged.push_back(history.settled && measure::clogged(state, model.grains().occupancy(), outlet,
                                                          model.grains().down()));
  }
  results.emplace_back("discharged", static_cast<double>(history.outflow.during_stage().particles));
  results.emplace_back("discharged_share", history.discharged_share());
  results.emplace_back("clogged", std::find(clogged.begin(), clogged.end(), true) != clogged.end());
  if (counts_apart(scene)) {
    add_outflow_apart(results, scene, model, history, clogged);
  }
}

void add_segregation(Results& results, const grains::State& state, double cell) {
  results.emplace_back("segregation_index",
                       store::value_or_null(measure::segregation_index(state)));
  results.emplace_back("lacey_index", store::value_or_null(measure::lacey_index(state, cell)));
}

void add_convection(Results& results, const Records& records) {
  const measure::Convection* convection = records.cycles().convection();
  if (convection == nullptr) {
    return;
  }
  const auto rolls = convection->rolls();
  const auto of = [&](double measure::ConvectionRolls::*member) {
    return rolls ? store::MeasureValue(*rolls.*member) : store::MeasureValue();
  };
  results.emplace_back("convection_centre_minus_wall",
                       of(&measure::ConvectionRolls::centre_minus_wall));
  results.emplace_back("convection_circulation_left",
                       of(&measure::ConvectionRolls::circulation_left));
  results.emplace_back("convection_circulation_right",
                       of(&measure::ConvectionRolls::circulation_right));
}

void add_mixing(Results& results, const measure::Mixing& mixing) {
  const auto at = [&](std::size_t diameters, double (measure::FallenPairs::*value)() const) {
    const auto& fallen = mixing.fallen();
    return diameters <= fallen.size() ? store::MeasureValue((fallen[diameters - 1].*value)())
                                      : store::MeasureValue();
  };
  results.emplace_back("neighbours_kept_1", at(1, &measure::FallenPairs::kept_share));
  results.emplace_back("neighbours_kept_10", at(10, &measure::FallenPairs::kept_share));
  results.emplace_back("pair_diffusion_5", at(5, &measure::FallenPairs::diffusion));
}

void add_fluctuations(Results& results, const FieldRecord& fields) {
  const measure::Fluctuations& fluctuations = fields.fluctuations();
  const auto distance = [&](const std::vector<double>& shares) {
    const auto reference = statistics::chi_square_shares(fluctuations.bins(), 2);
    return fluctuations.samples() > 0
               ? store::MeasureValue(statistics::hellinger_distance(shares, reference))
               : store::MeasureValue();
  };
  results.emplace_back("fluctuation_energy", fields.fluctuation_energy());
  results.emplace_back("fluctuation_hellinger", distance(fluctuations.shares()));
  results.emplace_back("fluctuation_hellinger_local", distance(fluctuations.local_shares()));
  results.emplace_back("fluctuation_samples", static_cast<double>(fluctuations.samples()));
  results.emplace_back("fluctuation_resting_share", fluctuations.resting_share());
  results.emplace_back("fluctuation_sparse_share", fluctuations.sparse_share());
}

}  // namespace

double StageHistory::discharged_share() const {
  const auto all = static_cast<double>(particles_at_start + emitted);
  return all > 0 ? static_cast<double>(outflow.during_stage().particles) / all : 0;
}

Results stage_measures(const scene::Scene& scene, const Model& model, const StageHistory& history,
                       const Records& records) {
  const grains::State& state = model.state();
  Results results;
  for (const scene::Measure measure : scene.measures) {
    switch (measure) {
      case scene::Measure::profile:
        break;  // a table of its own
      case scene::Measure::repose:
        add_repose(results, state);
        if (has_vessel(scene)) {
          add_repose_in_gravity(results, model);
        }
        break;
      case scene::Measure::runout:
        add_runout(results, state);
        break;
      case scene::Measure::packing:
        add_packing(results, state);
        break;
      case scene::Measure::moved:
        add_moved(results, state);
        break;
      case scene::Measure::outflow:
        add_outflow(results, scene, model, history);
        break;
      case scene::Measure::force:
        if (records.contacts()) {
          add_contact_forces(results, model, records.contacts()->at_end(model));
        }
        if (records.forces()) {
          add_force(results, model, history.profile_at_start, *records.forces());
        }
        break;
      case scene::Measure::segregation:
        if (scene.species.size() > 1) {
          add_segregation(results, state, records.cycles().cell());
        }
        break;
      case scene::Measure::intruder:
        if (const auto height = measure::intruder_height(state)) {
          results.emplace_back("intruder_height_rel", *height);
        }
        break;
      case scene::Measure::convection:
        add_convection(results, records);
        break;
      case scene::Measure::mixing:
        add_mixing(results, *records.mixing());
        break;
    }
  }
  if (records.fields()) {
    add_fluctuations(results, *records.fields());
  }
  if (const auto growth = records.energy() ? records.energy()->growth() : std::nullopt) {
    results.emplace_back("energy_growth", *growth);
  }
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
