#include "run/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/measure/contacts.hpp"
#include "clca/scene/contact.hpp"
#include "grains/internal/separation.hpp"

namespace clca::run {

namespace {

// Fixed, so that pictures of a sequence are comparable. More sites in one contact are rare.
constexpr double kMaxOverlapSites = 6;  // sites
// Cells rarely visited by grains have too large errors.
constexpr double kMinWeight = 0.2;         // of the fullest cell's
constexpr double kMinDisplacement = 1e-3;  // spacings per cycle

/// Centre of the periodic image of a grain nearest to `first`.
Eigen::Vector2d far_centre(const grains::State& state, const grains::Particle& first,
                           std::size_t second) {
  const grains::Particle& other = state.particles[second];
  const lattice::Axial apart = grains::nearest_vector(state.lattice, first.site(), other.site());
  return lattice::position(first.site()) + lattice::position(apart) + state.shape(other).centroid();
}

/// A line from centre to centre, or to the overlap with a wall.
render::ForceLine line_of(const grains::State& state, const measure::OverlapContact& contact) {
  const Eigen::Vector2d from = grains::centre(state, state.particles[contact.first]);
  const auto sites = static_cast<double>(contact.sites);
  if (!grains::is_particle(contact.second)) {
    return {.from = from, .to = contact.point, .strength = sites};
  }
  const Eigen::Vector2d to =
      far_centre(state, state.particles[contact.first], static_cast<std::size_t>(contact.second));
  return {.from = from, .to = to, .strength = sites};
}

/// Lines from centre to centre, or to the wall.
DrawnOverlay contact_forces(const View& view, double strongest) {
  std::vector<render::ForceLine> lines;
  for (const contact::Force& force : *view.forces) {
    const grains::Particle& upper = view.state.particles[force.upper];
    const Eigen::Vector2d from = grains::centre(view.state, upper);
    Eigen::Vector2d to = force.point;
    if (grains::is_particle(force.other)) {
      to = far_centre(view.state, upper, static_cast<std::size_t>(force.other));
    }
    lines.push_back({.from = from, .to = to, .strength = force.along_normal});
  }
  return {render::force_network(lines, strongest),
          {render::force_key(strongest, fmt::format("{:g} grain weights", strongest))}};
}

DrawnOverlay overlaps(const View& view) {
  std::vector<render::ForceLine> lines;
  for (const measure::OverlapContact& contact : measure::contacts(view.state, view.occupancy)) {
    lines.push_back(line_of(view.state, contact));
  }
  return {render::force_network(lines, kMaxOverlapSites),
          {render::force_key(kMaxOverlapSites,
                             fmt::format("{:g} overlapped sites", kMaxOverlapSites))}};
}

double heaviest(const std::vector<measure::Arrow>& arrows) {
  double most = 0;
  for (const measure::Arrow& arrow : arrows) {
    most = std::max(most, arrow.weight);
  }
  return most;
}

DrawnOverlay arrows(const CycleRecord& cycles) {
  const measure::Convection* convection = cycles.convection();
  if (convection == nullptr || convection->cycles() == 0) {
    return {};
  }
  const std::vector<measure::Arrow> all = convection->arrows();
  const double enough = kMinWeight * heaviest(all);
  std::vector<render::FieldArrow> field;
  double longest = kMinDisplacement;
  for (const measure::Arrow& arrow : all) {
    if (arrow.weight >= enough) {
      field.push_back({arrow.centre, arrow.displacement});
      longest = std::max(longest, arrow.displacement.norm());
    }
  }
  return {render::arrow_field(field, cycles.cell(), longest),
          {render::arrow_key(cycles.cell(), longest, "spacings per cycle")}};
}

}  // namespace

double strongest_force(const scene::Scene& scene) {
  if (scene.output.frames && scene.output.frames->force_scale) {
    return *scene.output.frames->force_scale;
  }
  double diameters = 0;
  for (const scene::Species& species : scene.species) {
    diameters += species.shape.diameter();
  }
  const double grains = scene::contact_parameters(scene).fall_height *
                        static_cast<double>(scene.species.size()) / diameters;
  const double power = std::pow(10, std::floor(std::log10(2 * grains)));
  const double leading = 2 * grains / power;
  return power * (leading < 2 ? 1 : leading < 5 ? 2 : 5);
}

DrawnOverlay overlay_of(scene::Overlay overlay, const View& view, double strongest_force) {
  switch (overlay) {
    case scene::Overlay::forces:
      return view.forces != nullptr ? contact_forces(view, strongest_force) : overlaps(view);
    case scene::Overlay::arrows:
      return view.cycles != nullptr ? arrows(*view.cycles) : DrawnOverlay();
    case scene::Overlay::velocity:
    case scene::Overlay::none:
      break;
  }
  return {};
}

}  // namespace clca::run
