#include "run/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clca/grains/separation.hpp"
#include "clca/measure/contacts.hpp"

namespace clca::run {

namespace {

// Fixed, so that pictures of a sequence compare: more sites than this in one contact are rare.
constexpr double kStrongest = 6;  // sites
// Cells where grains come by only now and then say little.
constexpr double kLeastWeight = 0.2;  // of the fullest cell's
constexpr double kShortest = 1e-3;    // spacings per cycle

/// From centre to centre; a wall is met where it overlaps.
render::ForceLine line_of(const grains::State& state, const measure::Contact& contact) {
  const Eigen::Vector2d from = grains::centre(state, state.particles[contact.first]);
  const auto sites = static_cast<double>(contact.sites);
  if (!grains::is_particle(contact.second)) {
    return {.from = from, .to = contact.place, .strength = sites};
  }
  const grains::Particle& first = state.particles[contact.first];
  const grains::Particle& second = state.particles[static_cast<std::size_t>(contact.second)];
  const lattice::Axial apart = grains::nearest_vector(state.lattice, first.site(), second.site());
  const Eigen::Vector2d to =
      lattice::position(first.site()) + lattice::position(apart) + state.shape(second).centroid();
  return {.from = from, .to = to, .strength = sites};
}

Drawn forces(const View& view) {
  std::vector<render::ForceLine> lines;
  for (const measure::Contact& contact : measure::contacts(view.state, view.occupancy)) {
    lines.push_back(line_of(view.state, contact));
  }
  return {render::force_network(lines, kStrongest),
          {render::force_key(kStrongest, fmt::format("{:g} overlapped sites", kStrongest))}};
}

double heaviest(const std::vector<measure::Arrow>& arrows) {
  double most = 0;
  for (const measure::Arrow& arrow : arrows) {
    most = std::max(most, arrow.weight);
  }
  return most;
}

Drawn arrows(const CycleRecord& cycles) {
  const measure::Convection* convection = cycles.convection();
  if (convection == nullptr || convection->cycles() == 0) {
    return {};
  }
  const std::vector<measure::Arrow> all = convection->arrows();
  const double enough = kLeastWeight * heaviest(all);
  std::vector<render::FieldArrow> field;
  double longest = kShortest;
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

Drawn overlay_of(scene::Overlay overlay, const View& view) {
  switch (overlay) {
    case scene::Overlay::forces:
      return forces(view);
    case scene::Overlay::arrows:
      return view.cycles != nullptr ? arrows(*view.cycles) : Drawn();
    case scene::Overlay::none:
      break;
  }
  return {};
}

}  // namespace clca::run
