// Forces, convection and velocities in pictures.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "clca/measure/displacement.hpp"
#include "clca/measure/force.hpp"
#include "clca/measure/grid.hpp"
#include "clca/measure/weight_paths.hpp"
#include "clca/record/quantity.hpp"
#include "clca/scene/units.hpp"
#include "drawing/internal/frame_painter.hpp"

namespace clca::drawing {

namespace {

template <class ValueOf>
double species_mean(const scene::Scene& scene, ValueOf value_of) {
  double sum = 0;
  for (const scene::Species& species : scene.species) {
    sum += static_cast<double>(value_of(species.shape));
  }
  return sum / static_cast<double>(scene.species.size());
}

/// One `unit` of the contact model in SI units, where there are any; else 1.
/// `mean_mass`: see scene::UnitConversion.
double si_factor(std::optional<scene::UnitConversion> conversion, std::string_view unit,
                 double mean_mass) {
  if (!conversion) {
    return 1;
  }
  conversion->mean_mass = mean_mass;
  return conversion->in_si(1, unit);
}

}  // namespace

OverlayScales overlay_scales(const scene::Scene& scene) {
  constexpr double kDiameters = 3;      // in the width of a cell of velocities
  constexpr double kMostAcross = 30;    // cells along the longer side of the view
  constexpr double kOfAutomaton = 0.5;  // spacings per step
  constexpr double kOfFreeFall = 0.5;   // of the velocity at its end
  const scene::PictureOutput& frames = *scene.output.frames;
  const double mass = species_mean(scene, [](const lattice::Shape& shape) { return shape.size(); });
  const double diameter =
      species_mean(scene, [](const lattice::Shape& shape) { return shape.diameter(); });
  const double width = frames.view ? frames.view->right - frames.view->left : scene.box.width;
  const double height = frames.view ? frames.view->top - frames.view->bottom : scene.box.height;
  const double least_cell = std::max(width, height) / kMostAcross;
  OverlayScales scales = {
      .conversion = scene::unit_conversion(scene),
      .velocity_cell_size =
          frames.velocity_cell_side.value_or(std::max(kDiameters * diameter, least_cell)),
      .arrow_velocity = frames.longest_arrow_speed,
      .velocity_unit = {.singular = "spacing per step", .plural = "spacings per step"}};
  std::optional<scene::UnitConversion>& conversion = scales.conversion;
  if (conversion) {
    scales.step_velocity = conversion->velocity(1);
    scales.velocity_unit = {.singular = conversion->velocity_unit,
                            .plural = conversion->velocity_unit};
  }
  // In lattice spacings per step. The resolution is what a fall from the fall height ends with.
  const double velocity = scene.model == scene::Model::contact
                              ? kOfFreeFall * scene.contact_parameters.resolution
                              : kOfAutomaton;
  scales.middle_speed = frames.longest_arrow_speed.value_or(
      render::largest_round_number_up_to(scales.step_velocity * velocity));
  if (conversion) {
    scales.highest_spin = 2 * scales.middle_speed / (diameter * conversion->spacing);
  }
  const double grain_weight = si_factor(conversion, scene::kContactForceUnit, mass);
  scales.strongest_force = frames.widest_line_force.value_or(render::largest_round_number_up_to(
      2 * grain_weight * scene::contact_parameters(scene).fall_height / diameter));
  scales.highest_pressure = scales.strongest_force / grain_weight *
                            si_factor(conversion, scene::kStressUnit, mass) / diameter;
  return scales;
}

std::string OverlayScales::picture_unit(std::string_view unit) const {
  return record::shown_unit(unit, conversion);
}

double OverlayScales::unit_factor(std::string_view unit, const grains::State& state) const {
  return si_factor(conversion, unit, contact::mean_grain_mass(state));
}

double arrow_velocity_for(double typical, const OverlayScales& scales) {
  constexpr double kRest = 0.01;  // of the highest velocity
  return scales.arrow_velocity.value_or(
      typical > kRest * scales.middle_speed ? typical : scales.middle_speed);
}

namespace {

// Fixed, so that pictures of a sequence are comparable. More sites in one contact are rare.
constexpr double kMaxOverlapSites = 6;  // sites
// Cells rarely visited by grains have too large errors.
constexpr double kMinWeight = 0.2;         // of the fullest cell's
constexpr double kMinDisplacement = 1e-3;  // spacings per cycle

/// Adds a line from the centre of a grain to the nearest image of that of another, or of the point
/// where it meets a wall. At a periodic boundary it ends, and goes on at the other.
void add_line(const grains::State& state, const grains::Particle& first, grains::Owner body,
              const Eigen::Vector2d& point, double strength,
              std::vector<render::ForceLine>& lines) {
  const lattice::Lattice& lattice = state.lattice;
  const Eigen::Vector2d from = grains::centre_in_box(state, first);
  Eigen::Vector2d along = point - from;
  if (grains::is_particle(body)) {
    const grains::Particle& other = state.particles[grains::particle_id(body)];
    const lattice::Axial apart = lattice.shortest_vector(first.site(), other.site());
    along =
        lattice::position(apart) + state.shape(other).centroid() - state.shape(first).centroid();
  } else if (lattice.periodic()) {
    along.x() = std::remainder(along.x(), lattice.extent().x());
  }
  const Eigen::Vector2d to = from + along;
  const double left = lattice::Lattice::lower_left_corner().x();
  const double right = left + lattice.extent().x();
  if (!lattice.periodic() || (to.x() >= left && to.x() <= right)) {
    lines.push_back({.from = from, .to = to, .strength = strength});
    return;
  }
  const auto [out, in] = to.x() < left ? std::pair(left, right) : std::pair(right, left);
  const double height = from.y() + (out - from.x()) / along.x() * along.y();
  lines.push_back({.from = from, .to = {out, height}, .strength = strength});
  lines.push_back({.from = {in, height}, .to = lattice.image_in_box(to), .strength = strength});
}

render::Overlay contact_force_overlay(const PictureContent& content,
                                      const std::vector<contact::Force>& forces,
                                      const OverlayScales& scales) {
  const double grain_weight = scales.unit_factor(scene::kContactForceUnit, content.state);
  std::vector<render::ForceLine> lines;
  for (const contact::Force& force : forces) {
    add_line(content.state, content.state.particles[force.upper], force.other, force.point,
             grain_weight * force.normal_force, lines);
  }
  return render::force_network(lines, scales.strongest_force,
                               fmt::format("{:g} {}", scales.strongest_force,
                                           scales.picture_unit(scene::kContactForceUnit)));
}

render::Overlay weight_overlay(const PictureContent& content, measure::WeightRule rule,
                               const OverlayScales& scales) {
  const auto supported = measure::supported_grains(content.state, content.occupancy);
  return contact_force_overlay(
      content, measure::weight_paths(content.state, supported, rule).forces, scales);
}

render::Overlay overlap_overlay(const PictureContent& content) {
  std::vector<render::ForceLine> lines;
  for (const measure::OverlapContact& contact :
       measure::overlap_contacts(content.state, content.occupancy)) {
    add_line(content.state, content.state.particles[contact.first], contact.second, contact.point,
             static_cast<double>(contact.shared_sites), lines);
  }
  return render::force_network(lines, kMaxOverlapSites,
                               fmt::format("{:g} overlapped sites", kMaxOverlapSites));
}

render::Overlay convection_arrows(const record::CycleRecord& cycles) {
  const measure::Convection* convection = cycles.convection();
  if (convection == nullptr || convection->completed_cycles() == 0) {
    return {};
  }
  const std::vector<measure::ConvectionArrow> all = convection->arrows();
  const auto heaviest = std::ranges::max_element(all, {}, &measure::ConvectionArrow::weight);
  std::vector<render::FieldArrow> field;
  for (const measure::ConvectionArrow& arrow : all) {
    if (arrow.weight >= kMinWeight * heaviest->weight) {
      field.push_back({arrow.centre, arrow.displacement});
    }
  }
  const double scale = std::max(kMinDisplacement, render::typical_length(field));
  return render::arrow_field(field, cycles.cell_side(), scale,
                             {.singular = "spacing per cycle", .plural = "spacings per cycle"});
}

/// Arrows of the cells with enough grains. Their cost does not depend on the size of the box.
std::vector<render::FieldArrow> velocity_arrows(const grains::State& state,
                                                const measure::Snapshot& begin,
                                                const OverlayScales& scales) {
  if (state.step == begin.step()) {
    return {};
  }
  struct Sums {
    double sites = 0;
    Eigen::Vector2d displacement = Eigen::Vector2d::Zero();
  };
  const measure::Grid grid(state.lattice, scales.velocity_cell_size);
  std::map<std::size_t, Sums> cells;
  double enough = 0;
  for (const measure::Displacement& grain : begin.displacements(state)) {
    grid.share_out(grain.from + grain.vector, [&](std::size_t index, double share) {
      Sums& cell = cells[index];
      cell.sites += share * grain.sites;
      cell.displacement += share * grain.sites * grain.vector;
      enough = std::max(enough, kMinWeight * cell.sites);
    });
  }
  const double per_step = scales.step_velocity / static_cast<double>(state.step - begin.step());
  std::vector<render::FieldArrow> result;
  for (const auto& [index, cell] : cells) {
    if (cell.sites >= enough) {
      result.push_back({grid.cell_centre(index), per_step / cell.sites * cell.displacement});
    }
  }
  return result;
}

render::Overlay velocity_overlay(const grains::State& state, const measure::Snapshot& begin,
                                 const OverlayScales& scales) {
  const std::vector<render::FieldArrow> field = velocity_arrows(state, begin, scales);
  const double scale = arrow_velocity_for(render::typical_length(field), scales);
  return render::arrow_field(field, scales.velocity_cell_size, scale, scales.velocity_unit);
}

}  // namespace

double typical_velocity(const PictureContent& content, const PictureHistory& history,
                        const OverlayScales& scales) {
  return render::typical_length(velocity_arrows(content.state, *history.window, scales));
}

render::Overlay overlay_of(scene::Overlay overlay, const PictureContent& content,
                           const PictureHistory& history, const OverlayScales& scales) {
  switch (overlay) {
    case scene::Overlay::forces:
      return content.contact ? contact_force_overlay(content, content.contact->forces, scales)
                             : overlap_overlay(content);
    case scene::Overlay::arrows:
      return content.cycles != nullptr ? convection_arrows(*content.cycles) : render::Overlay();
    case scene::Overlay::velocity:
      return velocity_overlay(content.state, *history.window, scales);
    case scene::Overlay::weight_inner:
      return weight_overlay(content, measure::WeightRule::inner, scales);
    case scene::Overlay::weight_outer:
      return weight_overlay(content, measure::WeightRule::outer, scales);
    case scene::Overlay::weight_pair:
      return weight_overlay(content, measure::WeightRule::pair, scales);
    case scene::Overlay::weight_q:
      return weight_overlay(content, measure::WeightRule::q, scales);
    case scene::Overlay::none:
      break;
  }
  return {};
}

}  // namespace clca::drawing
