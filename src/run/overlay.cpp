#include "run/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "clca/measure/contacts.hpp"
#include "clca/measure/grid.hpp"
#include "clca/measure/snapshot.hpp"
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
          {render::arrow_key(cycles.cell(), longest,
                             {.one = "spacing per cycle", .several = "spacings per cycle"})}};
}

/// Arrows of the cells with enough grains. Their cost does not depend on the size of the box.
std::vector<render::FieldArrow> velocity_arrows(const grains::State& state,
                                                const measure::Snapshot& begin,
                                                const OverlayScales& scales) {
  struct Sums {
    double sites = 0;
    Eigen::Vector2d displacement = Eigen::Vector2d::Zero();
  };
  const measure::Grid grid(state.lattice, scales.velocity_cell);
  std::map<std::size_t, Sums> cells;
  double enough = 0;
  for (const measure::Displacement& grain : begin.displacements(state)) {
    Sums& cell = cells[grid.index(grain.from + grain.vector)];
    cell.sites += grain.sites;
    cell.displacement += grain.sites * grain.vector;
    enough = std::max(enough, kMinWeight * cell.sites);
  }
  const double per_step = scales.step_velocity / static_cast<double>(state.step - begin.step());
  std::vector<render::FieldArrow> result;
  for (const auto& [index, cell] : cells) {
    if (cell.sites >= enough) {
      result.push_back({grid.centre(index), per_step / cell.sites * cell.displacement});
    }
  }
  return result;
}

DrawnOverlay velocities(const grains::State& state, const measure::Snapshot& begin,
                        const OverlayScales& scales) {
  const double cell = scales.velocity_cell;
  const double highest = scales.highest_velocity;
  std::vector<render::FieldArrow> field;
  if (state.step > begin.step()) {
    field = velocity_arrows(state, begin, scales);
  }
  DrawnOverlay drawn = {render::arrow_field(field, cell, highest),
                        {render::arrow_key(cell, highest, scales.velocity_unit)}};
  if (std::any_of(field.begin(), field.end(),
                  [&](const render::FieldArrow& arrow) { return arrow.vector.norm() > highest; })) {
    drawn.keys.push_back(render::cut_arrow_key(cell, fmt::format("above {:g}", highest)));
  }
  return drawn;
}

}  // namespace

DrawnOverlay overlay_of(scene::Overlay overlay, const View& view, const PictureHistory& history,
                        const OverlayScales& scales) {
  switch (overlay) {
    case scene::Overlay::forces:
      return view.forces != nullptr ? contact_forces(view, scales.strongest_force) : overlaps(view);
    case scene::Overlay::arrows:
      return view.cycles != nullptr ? arrows(*view.cycles) : DrawnOverlay();
    case scene::Overlay::velocity:
      return velocities(view.state, *history.window, scales);
    case scene::Overlay::none:
      break;
  }
  return {};
}

}  // namespace clca::run
