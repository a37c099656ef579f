// The definitions in full: docs/scene-format.md (Measures) and docs/boltzmann.md.

#include "report/internal/measure_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/text.hpp"

namespace clca::report {

namespace {

constexpr auto kMeasureNames = std::to_array<MeasureName>({
    {"repose_angle_deg", "Slope", "degrees", "mean of the flanks that are there"},
    {"repose_left_deg", "Slope, left flank", "degrees",
     "straight line through the surface between 15 % and 80 % of its height"},
    {"repose_right_deg", "Slope, right flank", "degrees", "the same on the other side"},
    {"vessel_angle_deg", "Angle of the vessel", "degrees", "anticlockwise from upright"},
    {"repose_gravity_deg", "Slope against gravity", "degrees",
     "mean of the flanks that are there, where gravity points down"},
    {"repose_gravity_left_deg", "Slope against gravity, left flank", "degrees",
     "straight line through the surface between 15 % and 80 % of its height"},
    {"repose_gravity_right_deg", "Slope against gravity, right flank", "degrees",
     "the same on the other side"},
    {"runout_99", "Run-out of 99 %", "spacings",
     "how far the 99th percentile of its sites lies beyond its origins"},
    {"runout_front", "Run-out of the front", "spacings",
     "how far the outermost site lies beyond the origins"},
    {"packing_fraction", "Packing fraction", "",
     "sites of particles over the sites that the bed could fill"},
    {"height_mean", "Mean height", "spacings", "of the surface, over the columns with particles"},
    {"moved_share", "Share moved", "",
     "of the particles, by more than the smallest diameter from where the stage began"},
    {"moved_share_2", "Share moved, 2 spacings", "", "by more than 2 spacings"},
    {"outflow_sites_per_step", "Outflow", "sites/step",
     "steady part: while 20 % to 70 % of what left the box left"},
    {"outflow_sites_per_time", "Outflow over time", "sites/time", "the same"},
    {"discharged_share", "Share discharged", "", "of the particles, through outlets, in the stage"},
    {"discharged", "Discharged", "particles", "through an outlet, in the stage"},
    {"discharged_until_clog", "Discharged until a clog", "particles",
     "all that left in the runs, over the number of clogs"},
    {"clogged", "Clogged", "",
     "at rest, particles hang over an outlet that they could have passed"},
    {"overlap_depth_max", "Deepest overlap", "moves",
     "moves that the deepest overlap would take back"},
    {"overlap_sites", "Overlap", "sites", "shared by all pairs that overlap"},
    {"overlap_contacts", "Pairs that overlap", "", ""},
    {"overlap_cone_share", "Overlap in the cone", "",
     "share of the sites within 45° ahead of the wall that pushed"},
    {"jammed", "Jammed", "particles", "pushed and at rest"},
    {"force_share_above_mean", "Contacts above the mean force", "", "their share"},
    {"force_tail_beta", "Tail of the forces, β", "",
     "of exp(-β f/⟨f⟩), which the forces above the mean f follow"},
    {"contacts_per_grain", "Contacts of a grain", "", "with grains and walls, mean"},
    {"balance_residual", "Balance of forces", "",
     "what forces and weight do not balance, over the weight; mean over grains"},
    {"load_floor", "Load on the floor", "",
     "force on the floor of the box over the weight of all grains"},
    {"energy_growth", "Growth of the energy", "",
     "most that it has grown in the stage, as a share of that at its start"},
    {"plate_depth", "Depth of the plate", "spacings",
     "of the deepest plate under the surface at the start of the stage"},
    {"stalled_since", "Stalled since", "step", "since when a wall wants to go on and cannot"},
    {"segregation_index", "Segregation index", "",
     "height of the large ones over the small ones, over half the bed"},
    {"lacey_index", "Lacey’s index of mixing", "", "0 separated, 1 as random"},
    {"intruder_height_rel", "Height of the intruder", "",
     "0 on the floor, 1 just buried at the top"},
    {"convection_centre_minus_wall", "Convection, centre less walls", "spacings/cycle",
     "rise inside less that at the walls"},
    {"convection_circulation_left", "Circulation, left half", "rad/cycle", "anticlockwise"},
    {"convection_circulation_right", "Circulation, right half", "rad/cycle", "anticlockwise"},
    {"neighbours_kept_1", "Neighbours kept, 1 d", "",
     "share still neighbours when they have fallen one mean diameter"},
    {"neighbours_kept_10", "Neighbours kept, 10 d", "", "after ten"},
    {"pair_diffusion_5", "Diffusion of pairs", "spacings",
     "⟨(Δx₁ - Δx₂)²⟩ over 4 times the distance fallen, at five mean diameters"},
    {"fluctuation_energy", "Energy of fluctuations", "(spacings/step)²",
     "½⟨|v - ⟨v⟩|²⟩, mean over cells and windows"},
    {"fluctuation_hellinger", "Distance from chi-square", "",
     "of the distribution of the fluctuations (Hellinger), over the mean of the window"},
    {"fluctuation_hellinger_local", "Distance from chi-square, local", "",
     "the same, over the mean of the cell"},
    {"fluctuation_samples", "Samples of fluctuations", "", "particles × windows"},
    {"fluctuation_resting_share", "Left out: resting", "", "in cells that rest or move as one"},
    {"fluctuation_sparse_share", "Left out: sparse", "", "in cells of fewer than 5 particles"},
    {"restitution", "Restitution ε", "", "normal restitution of the spheres"},
    {"hellinger_floor", "Distance by sampling alone", "",
     "Hellinger distance that a sample without any difference has"},
    {"time", "Time", "1/(π N (2a)² v₀)", "at the end"},
    {"gases", "Gases", "", "members of the ensemble"},
    {"t_tr", "Translational temperature", "", "relative to time 0"},
    {"t_rot", "Rotational temperature", "", "relative to time 0"},
    {"collisions", "Collisions", "", "per particle, since time 0"},
    {"a2_tr", "Second cumulant, velocities", "", "3⟨v⁴⟩/(5⟨v²⟩²) - 1; 0 if normal"},
    {"a2_rot", "Second cumulant, spins", "", "the same of the spins"},
    {"dh_tr", "Distance, translational energy", "", "from chi-square (Hellinger)"},
    {"dh_rot", "Distance, rotational energy", "", "from chi-square (Hellinger)"},
    {"correlation", "Correlation of the energies", "",
     "⟨v²w²⟩/(⟨v²⟩⟨w²⟩) - 1 of speed and spin; 0 if independent"},
    {"alignment", "Alignment of spin and velocity", "", "0 if their angle is random"},
    {"p_xx", "Pressure p_xx", "mean pressure", ""},
    {"p_yy", "Pressure p_yy", "mean pressure", ""},
    {"p_xy", "Shear stress p_xy", "mean pressure", ""},
});

}  // namespace

std::string shown_unit(std::string_view unit, const std::optional<scene::Conversion>& units) {
  std::string text(unit);
  const auto replace = [&text](std::string_view word, const std::string& with) {
    const std::size_t place = text.find(word);
    if (place != std::string::npos) {
      text.replace(place, word.size(), with);
    }
  };
  if (units) {
    replace("spacings/step", units->velocity_unit);
    replace("sites/time", "sites/" + units->time_unit);
  }
  return text;
}

const MeasureName* find_measure_name(std::string_view key) {
  const std::string_view measure = key.substr(0, key.find('.'));
  const auto* found = std::find_if(kMeasureNames.begin(), kMeasureNames.end(),
                                   [&](const MeasureName& one) { return one.key == measure; });
  return found == kMeasureNames.end() ? nullptr : found;
}

std::string measure_heading(const std::string& key) {
  const MeasureName* known = find_measure_name(key);
  if (known == nullptr) {
    return fmt::format(R"(<th scope="row">{}</th>)", escaped(key));
  }
  const std::string of = key.substr(known->key.size());  // `.OUTLET`, or nothing
  return fmt::format(
      R"(<th scope="row">{}{}{}</th>)", escaped(known->name),
      of.empty() ? "" : fmt::format(" ({})", escaped(of.substr(1))),
      known->meaning.empty() ? "" : fmt::format("<small>{}</small>", escaped(known->meaning)));
}

std::string unit_of_measure(const std::string& key, const std::optional<scene::Conversion>& units) {
  const MeasureName* known = find_measure_name(key);
  return known == nullptr ? "" : shown_unit(known->unit, units);
}

}  // namespace clca::report
